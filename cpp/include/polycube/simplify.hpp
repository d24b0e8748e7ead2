/// @file
/// From a polycube to the coarsest good one with the same topology.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <polycube/context.hpp>
#include <polycube/error.hpp>
#include <polycube/mesh.hpp>
#include <string>
#include <vector>

namespace polycube {

/// How the levels find their places.
enum class Strategy : std::uint8_t {
    naive,  ///< Round every level to the lattice. May break the polycube.
    paper,  ///< Algorithm 1 of the paper.
    best,   ///< A search for the smallest count.
};

/// Who solves the integer problems.
enum class Solver : std::uint8_t {
    exact,   ///< Minimum cuts.
    linear,  ///< Linear programs. Slow.
};

/// Which number shall be small; see `Counts`.
enum class Objective : std::uint8_t { blocks_padded, blocks, surface_patches };

/// How long `Strategy::best` searches.
struct Effort {
    /// Moves tried per level in each of the eight chains.
    std::uint32_t steps_per_level = 400;
    /// Partial orders that the proof of a lower bound looks at; 0 for a quick bound.
    std::uint64_t proof_nodes = 200;
    /// Stop after so many seconds with the best found; the result then depends on the machine.
    std::optional<double> time_limit;
};

/// How far a mesh may be from a polycube and still be read as one.
struct Tolerance {
    /// Largest angle between a face and the nearest axis, in degrees; 0 to 45.
    double degrees = 30.0;
    /// Largest distance of a vertex from the plane of its facet, as a fraction of the bounding box's diagonal.
    double distance = 0.05;
    /// Levels closer than this fraction of the diagonal are taken to be equal.
    double merge = 1e-6;
};

/// A plane of symmetry to keep.
struct Symmetry {
    /// 0, 1 or 2: the axis that the plane is perpendicular to.
    std::uint32_t axis = 0;
    /// Where it lies along that axis, in units of the polycube.
    double at = 0.0;
};

/// What the user wants of single facets. Facets are numbered as in `Structure::facets`, boundary faces as in
/// `boundary()`.
struct Guides {
    /// Facets that must not move.
    std::vector<std::uint32_t> fixed;
    /// Boundary faces whose facets must not move: what a host has as a selection.
    std::vector<std::uint32_t> fixed_faces;
    /// Groups of facets of one axis that must lie in one plane.
    std::vector<std::vector<std::uint32_t>> together;
    /// Pairs of facets of one axis that must not lie in one plane.
    std::vector<std::array<std::uint32_t, 2>> apart;
    /// Planes of symmetry that must be kept.
    std::vector<Symmetry> symmetry;

    bool empty() const noexcept;
};

/// How a polycube is simplified.
struct Options {
    Strategy strategy = Strategy::best;
    /// Lattice steps per unit of the polycube, above 0. Without one: 1 if all levels are integers, else one step per
    /// mean mesh edge.
    std::optional<double> scale;
    /// Algorithm 1 stops before its weight of staying close falls below this: 0 for the coarsest result, 1 for one
    /// round.
    double lambda_min = 0.0;
    Solver solver = Solver::exact;
    /// What `Strategy::best` makes small. Without one: padded blocks for a volume, patches for a surface.
    std::optional<Objective> objective;
    Effort effort;
    /// How far `Strategy::best` goes, from 1, the fewest blocks (the default), to 0, the least displacement.
    std::optional<double> simplicity;
    /// The farthest that `Strategy::best` may move a corner, in units of the polycube; 0 where none shall move.
    std::optional<double> max_displacement;
    /// The largest mean angle distortion of the map from the shape to the result of `Strategy::best` to accept, at
    /// least 1: of the front, the point with the fewest blocks that keeps it is taken.
    std::optional<double> max_distortion;
    /// Take the input as it is. Else what has one right answer is repaired and told in `Report::notes`: cells that are
    /// numbered left-handed, surfaces and labels that look inward, vertices at one place, faces that are double or
    /// inside.
    bool no_repair = false;
    Tolerance tolerance;
    Guides guides;
};

/// What is worked on: borrowed for the duration of a call.
struct Input {
    /// The polycube. Boundary faces must look along the axes, within the tolerance.
    const Mesh* polycube = nullptr;
    /// The shape it was deformed from, with the same cells; null if there is none.
    const Mesh* shape = nullptr;
    /// One label for each boundary face, 0 to 5 for +X -X +Y -Y +Z -Z, -1 for "by the normal"; null for the normals
    /// alone.
    const std::vector<std::int8_t>* labels = nullptr;

    explicit Input(const Mesh& polycube_) noexcept : polycube(&polycube_) {}
    Input(const Mesh& polycube_, const Mesh& shape_) noexcept : polycube(&polycube_), shape(&shape_) {}
};

/// How coarse a block structure is.
struct Counts {
    /// Quadrilateral patches on the surface, cut by the lines that run straight on from every corner.
    std::uint64_t surface_patches = 0;
    /// Blocks of the solid, cut by the sheets that run on from every reflex edge.
    std::uint64_t blocks = 0;
    /// Blocks once a layer of hexahedra lies around the solid.
    std::uint64_t blocks_padded = 0;
};

/// A round of Algorithm 1.
struct Round {
    double lambda = 0.0;           ///< The weight of the attraction to the input.
    std::uint64_t pairs = 0;       ///< Corner pairs that were asked to align.
    std::uint64_t alignments = 0;  ///< Levels that became aligned.
    Counts counts;                 ///< Counts after the round.
};

/// One way to trade blocks for displacement.
struct TradeOff {
    std::uint64_t count = 0;    ///< What the objective counts.
    double displacement = 0.0;  ///< Root mean square of the corners' displacement, in units of the input.
};

/// What is proven of the least count.
struct LowerBound {
    std::uint64_t count = 0;  ///< No valid polycube of this structure counts less.
    bool proven = false;      ///< Whether the search reached it, so that its result is the optimum.
};

/// How a map distorts: angle and size parts, at least 1, 1 for none.
struct Distortion {
    double angle = 1.0;            ///< Mean of the angle part.
    double size = 1.0;             ///< Mean of the size part.
    double worst_angle = 1.0;      ///< Largest angle part.
    double worst_size = 1.0;       ///< Largest size part.
    std::uint32_t worst_cell = 0;  ///< The first cell with the largest angle part.
};

/// Time spent, in seconds.
struct Seconds {
    double structure = 0.0;  ///< Finding and checking the structure.
    double align = 0.0;      ///< Pairing, aligning, counting.
    double morph = 0.0;      ///< Morphing the mesh and judging it.
    double total = 0.0;      ///< All of it.
};

/// What a simplification did. `Simplified::report_json` has all of it and more.
struct Report {
    double scale = 1.0;  ///< Lattice steps per unit of the input.
    bool valid = false;  ///< Whether the result is a valid polycube. Only `Strategy::naive` can give one that is not.
    Counts before;       ///< Counts of the input.
    std::optional<Counts> after;  ///< Counts of the result, if it is valid.
    std::vector<Round> rounds;    ///< The rounds of Algorithm 1.
    std::vector<TradeOff>
        front;  ///< Trade-offs met, from the fewest blocks on: the points that `Simplified::at` chooses from.
    std::optional<std::uint64_t> chosen;  ///< Which point of the front the result is, from 0; nothing if it is none.
    std::optional<LowerBound> bound;      ///< What `Strategy::best` could prove.
    Seconds seconds;                      ///< Time spent.
    double max_displacement = 0.0;        ///< The farthest that a corner moved, in units of the input.
    std::vector<std::uint32_t> flipped_cells;     ///< Cells of a volume that the morph turned over.
    std::vector<std::uint32_t> flipped_faces;     ///< Boundary faces that it turned over.
    double deviation_degrees = 0.0;               ///< How far faces of the input are off their axes.
    double deviation_distance = 0.0;              ///< How far vertices of the input are off their facets, in its units.
    std::optional<Distortion> distortion_before;  ///< Of the map from the shape to the polycube as it came.
    std::optional<Distortion> distortion_after;   ///< Of the map from the shape to the result.
    std::vector<std::string> notes;               ///< What was not possible or not as asked, in plain words.
};

/// A simplified polycube. Immutable; copies share it; safe to read from several threads.
class Simplified {
 public:
    /// What was done.
    const Report& report() const noexcept;
    /// The same and more as JSON: what the command writes to report.json, without its files and options.
    const std::string& report_json() const noexcept;

    /// Whether there is a valid polycube.
    bool valid() const noexcept { return report().valid; }
    /// The simplified polycube in lattice units, with the cells of the input.
    /// @throws Error polycube when it is not valid.
    const Mesh& polycube() const;
    /// The lattice coordinate of every level, as `Structure::levels` counts them.
    const std::vector<std::int64_t>& levels() const noexcept;
    /// The label of every boundary face, 0 to 5.
    const std::vector<std::int8_t>& labels() const noexcept;
    /// The facet of every boundary face, as `Structure::facets` counts them.
    const std::vector<std::uint32_t>& facet_of_face() const noexcept;
    /// The surface patch that the middle of every boundary face lies in after simplification, from 0; for colouring.
    /// Empty when it is not valid.
    const std::vector<std::uint32_t>& patch_of_face() const noexcept;
    /// The block below the middle of every boundary face after simplification, from 0. Empty when it is not valid.
    const std::vector<std::uint32_t>& block_of_face() const noexcept;

    /// Another point of the same front, from 1, the fewest blocks, to 0, the least displacement, without any search:
    /// for a slider. `input` is what was simplified. Needs `Strategy::best`.
    ///
    /// @throws Error mismatch (another input), option (outside of [0, 1]), cancelled.
    Simplified at(const Input& input, double simplicity, const Context& context = {}) const;
    /// The same block structure at another scale, in lattice steps per unit of the input; fast.
    ///
    /// @throws Error mismatch (another input), option (a scale that is not positive or too large), cancelled.
    Simplified rescaled(const Input& input, double scale, const Context& context = {}) const;

    struct State;
    /// For the library itself.
    explicit Simplified(std::shared_ptr<const State> state) noexcept : state_(std::move(state)) {}

 private:
    std::shared_ptr<const State> state_;
};

/// Simplifies a polycube: finds its structure, aligns its corners on the integer lattice, and morphs the mesh onto the
/// result.
///
/// The result has the topology of the input, never more blocks, and is the same bytes for any number of threads.
///
/// @code
/// polycube::Options options;
/// options.max_displacement = 3.0;  // units of the polycube
/// options.guides.fixed_faces = {0};
/// const polycube::Simplified simple = polycube::simplify({cube, shape}, options);
/// polycube::write_mesh("simple.obj", simple.polycube());
/// const polycube::Simplified near = simple.at({cube, shape}, 0.0);  // for a slider
/// @endcode
///
/// @throws Error mesh or polycube (the first violation, see `check()` for all), mismatch, option, infeasible,
/// cancelled.
Simplified simplify(const Input& input, const Options& options = {}, const Context& context = {});

}  // namespace polycube
