/// @file
/// MeshLab's layers as plain buffers, and plain buffers as new layers.
#pragma once

#include <cstdint>
#include <polycube/mesh.hpp>
#include <string>
#include <vector>

#include "host.h"

/// A layer as the core counts it.
struct Plain {
    /// Vertices and faces that were deleted, and vertices that no face uses, are left out; the others keep their order.
    polycube::Mesh mesh;
    /// The cell of `mesh` that each live face of the layer belongs to, alone or with the other half of a quadrilateral.
    std::vector<std::uint32_t> cell_of_face;
};

/// Reads the triangles of a layer.
Plain read_triangles(const CMeshO& mesh);

/// Reads a layer; as quadrilaterals if faux edges pair all its triangles. How MeshLab splits a quadrilateral depends on
/// its form, so that only whole ones are alike on a polycube and its shape.
Plain read(const CMeshO& mesh);

/// The faces of a layer that are not deleted.
std::vector<const CFaceO*> live_faces(const CMeshO& mesh);
std::vector<CFaceO*> live_faces(CMeshO& mesh);

/// The cells of which a face is selected, in order.
std::vector<std::uint32_t> selected_cells(const CMeshO& mesh, const Plain& plain);

/// One scalar for every cell of a plain mesh, kept as a custom attribute of the layer under this name.
struct Scalars {
    std::string name;
    std::vector<double> values;
};

/// Puts a mesh of triangles or quadrilaterals into an empty layer. MeshLab keeps a quadrilateral as two triangles with
/// a faux edge between them.
void write(const polycube::Mesh& mesh, MeshModel& layer);

/// What `Plain::cell_of_face` is of a layer that `write` filled.
std::vector<std::uint32_t> cells_of_written(const polycube::Mesh& mesh);

/// Colours the faces of a layer and gives them scalars; the first of these is the one that MeshLab shows. There is one
/// colour and one scalar for each cell.
void paint(const std::vector<std::uint32_t>& cell_of_face, const std::vector<vcg::Color4b>& colours,
           const std::vector<Scalars>& scalars, MeshModel& layer);

/// Makes the edges of `to` faux that are so in `from`, which has the same faces.
void copy_faux_edges(const CMeshO& from, CMeshO& to);

/// The colour of an axis: X red, Y white, Z blue; a negative direction is darker.
vcg::Color4b colour_of_label(int label);

/// Colours that differ from number to number; the same number always has the same one.
vcg::Color4b colour_of_number(std::uint32_t number);

/// The mean length of a layer's edges in its units; 0 without faces.
double mean_edge(const CMeshO& mesh);

/// New layers that are taken back unless `keep` is called: an error half-way leaves the document as it was.
class NewLayers {
 public:
    explicit NewLayers(MeshDocument& document) : document_(document), current_(document.mm()) {}
    NewLayers(const NewLayers&) = delete;
    NewLayers& operator=(const NewLayers&) = delete;
    ~NewLayers();

    /// A layer that holds `mesh`, at the place of `origin` where there is one.
    MeshModel& add(const polycube::Mesh& mesh, const QString& label, const MeshModel* origin);
    /// Lets the layers stay and makes the last one current.
    void keep();

 private:
    MeshDocument& document_;
    MeshModel* current_;
    std::vector<MeshModel*> added_;
};
