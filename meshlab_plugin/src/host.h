/// @file
/// The two faces of MeshLab's plugin interface, 2020.09's and that of 2021.05 to 2025.07, behind one set of names.
#pragma once

#include <QString>
#include <map>
#include <string>
#include <vector>

#if POLYCUBE_MESHLAB_2020
#include <common/filter_parameter/rich_parameter.h>
#include <common/interfaces.h>
#else
#include <common/plugins/interfaces/filter_plugin.h>
#if __has_include(<common/parameters/rich_parameters.h>)
#include <common/parameters/rich_parameters.h>
#else
#include <common/parameters/rich_parameter.h>
#endif
#endif

namespace host {

#if POLYCUBE_MESHLAB_2020
using FilterPlugin = MeshFilterInterface;
using Action = QAction;
using FilterId = MeshFilterInterface::FilterIDType;
using Arity = MeshFilterInterface::FILTER_ARITY;
using FileSave = RichSaveFile;
using Percentage = RichAbsPerc;
#else
using FilterPlugin = ::FilterPlugin;
using Action = const QAction;
using FilterId = ::FilterPlugin::ActionIDType;
using Arity = ::FilterPlugin::FilterArity;
#if __has_include(<common/parameters/rich_parameters.h>)
using FileSave = RichFileSave;
using Percentage = RichPercentage;
#else
using FileSave = RichSaveFile;
using Percentage = RichAbsPerc;
#endif
#endif

/// What a filter gives to PyMeshLab. It knows int, double and bool.
using Values = std::map<std::string, QVariant>;

/// All layers, from the first.
inline std::vector<const MeshModel*> layers(const MeshDocument& document) {
    std::vector<const MeshModel*> found;
#if POLYCUBE_MESHLAB_2020
    for (const MeshModel* layer : document.meshList) found.push_back(layer);
#else
    for (const MeshModel& layer : document.meshIterator()) found.push_back(&layer);
#endif
    return found;
}

/// A parameter that chooses a layer.
inline RichMesh layer_parameter(const QString& name, const MeshModel* preset, const MeshDocument& document,
                                const QString& label, const QString& tip) {
#if POLYCUBE_MESHLAB_2020
    return RichMesh(name, const_cast<MeshModel*>(preset), const_cast<MeshDocument*>(&document), label, tip);
#else
    return RichMesh(name, preset != nullptr ? preset->id() : 0, &document, label, tip);
#endif
}

/// The layer chosen; null if there is no such layer.
inline MeshModel* chosen_layer(const RichParameterList& parameters, const QString& name, MeshDocument& document) {
#if POLYCUBE_MESHLAB_2020
    (void)document;
    return parameters.getMesh(name);
#else
    return document.getMesh(parameters.getMeshId(name));
#endif
}

inline void remove_layer(MeshDocument& document, MeshModel* layer) {
#if POLYCUBE_MESHLAB_2020
    document.delMesh(layer);
#else
    document.delMesh(layer->id());
#endif
}

inline void update_box_and_normals(MeshModel& layer) {
#if POLYCUBE_MESHLAB_2020
    layer.UpdateBoxAndNormals();
#else
    layer.updateBoxAndNormals();
#endif
}

}  // namespace host
