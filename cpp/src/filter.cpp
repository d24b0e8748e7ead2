#include <algorithm>
#include <polycube/filter.hpp>
#include <sstream>

namespace polycube::filter {
namespace {

using Lines = std::vector<std::string>;

// What the core takes of a pair; the pair must outlive it.
Input input_of(const Pair& pair) {
    Input input(pair.polycube);
    if (!pair.shape.cells.empty()) input.shape = &pair.shape;
    if (!pair.labels.empty()) input.labels = &pair.labels;
    return input;
}

RemeshOptions options_of(const Pair& pair, const Settings& settings) {
    RemeshOptions options = settings.options;
    std::vector<std::uint32_t>& locked = options.simplify.guides.fixed_faces;
    locked.insert(locked.end(), pair.locked_faces.begin(), pair.locked_faces.end());
    return options;
}

template <class... Parts>
std::string line(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

std::string counts(const Counts& c) {
    return line(c.surface_patches, " patches, ", c.blocks, " blocks, ", c.blocks_padded, " blocks padded");
}

void add_report(Lines& log, const Report& report) {
    log.push_back(line("before: ", counts(report.before)));
    if (report.after) log.push_back(line("after:  ", counts(*report.after)));
    if (report.bound) {
        log.push_back(line(report.bound->proven ? "proven optimal: " : "not below ", report.bound->count,
                           report.bound->proven ? " is the least count" : " by a proven bound"));
    }
    log.push_back(line("largest displacement of a corner: ", report.max_displacement, " units"));
    if (report.distortion_before && report.distortion_after) {
        log.push_back(line("distortion of angles: ", report.distortion_before->angle, " before, ",
                           report.distortion_after->angle, " after"));
    }
    for (const std::string& note : report.notes) log.push_back("note: " + note);
}

void describe(Inspection& found, const Structure& structure) {
    found.log.push_back("this is a valid polycube");
    found.log.push_back(line(structure.facets.size(), " facets, ", structure.corners.size(), " corners, ",
                             structure.edges.size(), " edges, ", structure.levels.size(), " levels"));
    found.log.push_back(counts(structure.counts));
    found.log.push_back(line("genus ", structure.genus, ", ", structure.components, " component(s)"));
}

void list(Inspection& found, const std::vector<Violation>& violations) {
    found.log.push_back(line("this is not a valid polycube: ", violations.size(), " violation(s)"));
    for (const Violation& v : violations) {
        const std::string where = to_string(v.place);
        found.log.push_back(line(where, where.empty() ? "" : ": ", v.message, " (", v.remedy, ")"));
        found.bad_faces.insert(found.bad_faces.end(), v.faces.begin(), v.faces.end());
    }
    std::sort(found.bad_faces.begin(), found.bad_faces.end());
    found.bad_faces.erase(std::unique(found.bad_faces.begin(), found.bad_faces.end()), found.bad_faces.end());
}

SimplifiedPair shown(Simplified simplified, const Settings& settings) {
    SimplifiedPair pair{simplified.polycube(),      simplified.labels(), simplified.patch_of_face(),
                        simplified.block_of_face(), simplified,          {}};
    if (settings.in_input_units) {
        for (double& x : pair.polycube.points) x /= simplified.report().scale;
    }
    add_report(pair.log, simplified.report());
    return pair;
}

void add_made(Lines& log, const Made& made) {
    log.push_back(line("polycube made of the shape: ", made.report.corners, " corners, ", made.report.facets,
                       " facets, genus ", made.report.genus));
    if (!made.report.folded.empty()) {
        log.push_back(line("warning: ", made.report.folded.size(), " triangles are turned over on the polycube"));
    }
}

Lines log_of(const Remeshed& result) {
    Lines log;
    if (result.made) add_made(log, *result.made);
    add_report(log, result.simplified.report());
    const RemeshReport& report = result.report;
    log.push_back(line(report.quads, " quadrilaterals"));
    if (report.hexes > 0) log.push_back(line(report.hexes, " hexahedra in ", report.hex_blocks, " blocks"));
    if (report.min_scaled_jacobian && report.mean_scaled_jacobian) {
        log.push_back(
            line("scaled Jacobian: smallest ", *report.min_scaled_jacobian, ", mean ", *report.mean_scaled_jacobian));
    }
    if (report.max_edge_ratio && report.min_determinant) {
        log.push_back(line("edge ratio: largest ", *report.max_edge_ratio, "; determinant: smallest ",
                           *report.min_determinant, " of the mean"));
    }
    log.push_back(line("Hausdorff distance to the shape: ", report.hausdorff_percent, " % of the diagonal"));
    for (const std::string& fault : report.faults) log.push_back("warning: " + fault);
    return log;
}

}  // namespace

Inspection inspect(const Pair& pair, const Settings& settings, const Context& context) {
    Inspection found;
    found.checked = check(input_of(pair), settings.options.simplify.tolerance, context);
    if (found.checked.structure) {
        describe(found, *found.checked.structure);
    } else {
        list(found, found.checked.violations);
    }
    return found;
}

SimplifiedPair simplify(const Pair& pair, const Settings& settings, const Context& context) {
    return shown(polycube::simplify(input_of(pair), options_of(pair, settings).simplify, context), settings);
}

SimplifiedPair slide(const Pair& pair, const SimplifiedPair& from, double simplicity, const Settings& settings,
                     const Context& context) {
    return shown(from.simplified.at(input_of(pair), simplicity, context), settings);
}

RemeshedPair remesh(const Pair& pair, const Settings& settings, const Context& context) {
    const RemeshOptions options = options_of(pair, settings);
    RemeshedPair meshed{pair.polycube.cells.empty() && !pair.shape.cells.empty()
                            ? polycube::remesh(pair.shape, options, context)
                            : polycube::remesh(input_of(pair), options, context),
                        {}};
    meshed.log = log_of(meshed.result);
    return meshed;
}

}  // namespace polycube::filter
