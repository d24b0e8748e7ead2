#include "options.h"

#include <stdexcept>

void add_tolerance(RichParameterList& parameters) {
    const polycube::Tolerance tolerance;
    parameters.addParam(
        RichFloat("angle_tolerance", Scalarm(tolerance.degrees), "Angle tolerance (degrees)",
                  "The largest angle between a face of the polycube and the nearest axis, 0 to 45 degrees."));
    parameters.addParam(RichFloat("level_tolerance", Scalarm(100.0 * tolerance.distance), "Level tolerance (%)",
                                  "The largest distance of a vertex of the polycube from the plane of its side, in "
                                  "percent of the bounding box's diagonal, 0 to 100."));
}

polycube::Tolerance chosen_tolerance(const RichParameterList& parameters) {
    polycube::Tolerance tolerance;
    tolerance.degrees = parameters.getFloat("angle_tolerance");
    tolerance.distance = parameters.getFloat("level_tolerance") / 100.0;
    return tolerance;
}

void add_choice(RichParameterList& parameters, const QString& more) {
    parameters.addParam(
        RichDynamicFloat("simplicity", 1, 0, 1, "Simplicity",
                         "From 1, the fewest that the search finds, to 0, the least change of the polycube." + more));
    // No length with percentages, which takes two lines: MeshLab shows no more than a dozen.
    parameters.addParam(RichFloat("max_displacement", 0, "Displacement limit (0 is none)",
                                  "The farthest that the search may move a corner of the polycube, in its units; of "
                                  "what keeps to it, the fewest are taken. 0 is no limit."));
}

void set_choice(const RichParameterList& parameters, polycube::Options& options) {
    options.simplicity = parameters.getDynamicFloat("simplicity");
    if (!(*options.simplicity >= 0.0 && *options.simplicity <= 1.0))
        throw std::invalid_argument("The simplicity must be 0 to 1.");
    if (const double most = parameters.getFloat("max_displacement"); most != 0.0) options.max_displacement = most;
}

void add_choice_by_quality(RichParameterList& parameters, const QString& what) {
    parameters.addParam(
        RichBool("by_quality", true, "Simplicity by quality",
                 "Take the fewest " + what +
                     ", whatever the simplicity. A displacement limit decides instead where it is set."));
    add_choice(parameters, " Without <i>Simplicity by quality</i> only.");
}

void set_choice_by_quality(const RichParameterList& parameters, polycube::Options& options) {
    set_choice(parameters, options);
    if (parameters.getBool("by_quality")) options.simplicity.reset();
}
