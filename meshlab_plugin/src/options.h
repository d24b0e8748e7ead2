/// @file
/// The options that filters share: how exact a polycube must be, and which of the results found is taken.
#pragma once

#include <polycube/simplify.hpp>

#include "filter.h"

/// Adds the parameters `angle_tolerance` and `level_tolerance`.
void add_tolerance(RichParameterList& parameters);

/// What they say.
polycube::Tolerance chosen_tolerance(const RichParameterList& parameters);

/// Adds the parameters `simplicity` and `max_displacement`; `more` is told of the first.
void add_choice(RichParameterList& parameters, const QString& more = {});

/// Adds them after `by_quality`, which takes the fewest `what` instead of what the simplicity says.
void add_choice_by_quality(RichParameterList& parameters, const QString& what);

/// Puts what they say into `options`. @throws std::invalid_argument for a simplicity out of its range.
void set_choice(const RichParameterList& parameters, polycube::Options& options);

/// The same with `by_quality`, which leaves the simplicity to the library.
void set_choice_by_quality(const RichParameterList& parameters, polycube::Options& options);
