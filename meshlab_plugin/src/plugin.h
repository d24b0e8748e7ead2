/// @file
/// The plugin as MeshLab sees it: hands its calls on to the filters and lets no exception out that MeshLab does not
/// catch.
#pragma once

#include <QObject>

#include "filter.h"

class PolycubePlugin : public QObject, public host::FilterPlugin {
    Q_OBJECT
#if POLYCUBE_MESHLAB_2020
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)
#else
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)
#endif

 public:
    PolycubePlugin();

    QString pluginName() const override { return "FilterPolycube"; }
    QString filterName(host::FilterId filter) const override;
    QString filterInfo(host::FilterId filter) const override;
    host::Arity filterArity(host::Action* action) const override;
    int getPreConditions(host::Action* action) const override;
    int postCondition(host::Action* action) const override;

#if POLYCUBE_MESHLAB_2020
    FilterClass getClass(QAction* action) override { return filter(action).submenu(); }
    void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) override;
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                     vcg::CallBackPos* progress) override;
#else
    QString vendor() const override { return "Polycube"; }
    QString pythonFilterName(host::FilterId filter) const override;
    FilterClass getClass(const QAction* action) const override { return filter(action).submenu(); }
    RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
    host::Values applyFilter(const QAction* action, const RichParameterList& parameters, MeshDocument& document,
                             unsigned int& post_condition, vcg::CallBackPos* progress) override;
#endif

 private:
    const Filter& filter(host::FilterId id) const { return *filters_.at(std::size_t(id)); }
    const Filter& filter(host::Action* action) const { return filter(ID(action)); }
    void propose(const Filter& filter, const MeshDocument& document, RichParameterList& parameters);
    host::Values run(const Filter& filter, const RichParameterList& parameters, MeshDocument& document,
                     vcg::CallBackPos* progress);
    void write_log(const std::string& line);

    std::vector<std::unique_ptr<Filter>> filters_;
};
