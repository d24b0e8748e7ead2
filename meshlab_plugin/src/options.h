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

/// Puts what they say into `options`. @throws std::invalid_argument for a simplicity out of its range.
void set_choice(const RichParameterList& parameters, polycube::Options& options);
