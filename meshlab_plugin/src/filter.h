/// @file
/// One entry of the Filters menu.
#pragma once

#include <functional>
#include <memory>
#include <polycube/context.hpp>
#include <string>
#include <vector>

#include "host.h"

/// What a filter gets to do its work.
struct Call {
    const RichParameterList& parameters;
    MeshDocument& document;
    /// Shows progress in the host.
    const polycube::Context& context;
    /// Writes a line to the host's log.
    std::function<void(const std::string&)> log;

    /// Writes many lines to the log.
    void log_all(const std::vector<std::string>& lines) const {
        for (const std::string& line : lines) log(line);
    }
};

/// One entry of the Filters menu. Filters compute first and touch the document last, so that an error leaves it as it
/// was.
class Filter {
 public:
    virtual ~Filter() = default;

    /// The text of the menu entry; scripts of MeshLab find the filter by it.
    virtual QString name() const = 0;
    /// The name in PyMeshLab, verb first.
    virtual QString python_name() const = 0;
    /// Help, as HTML without the citation.
    virtual QString help() const = 0;
    /// The submenu it is in.
    virtual host::FilterPlugin::FilterClass submenu() const { return host::FilterPlugin::Remeshing; }
    /// Which layers it works on.
    virtual host::Arity arity() const { return host::FilterPlugin::FIXED; }
    /// What it changes, as bits of `MeshModel::MeshElement`.
    virtual int changes() const = 0;
    /// The dialog's parameters, their defaults fitted to the document.
    virtual void add_parameters(const MeshDocument& document, RichParameterList& parameters) const = 0;
    /// Does it. @throws std::exception with a message for the user; the document is then as it was.
    virtual host::Values apply(const Call& call) const = 0;
};

/// All filters in the order of their numbers.
std::vector<std::unique_ptr<Filter>> make_filters();

std::unique_ptr<Filter> make_simplify_filter();
std::unique_ptr<Filter> make_layout_filter();
std::unique_ptr<Filter> make_quad_filter();
std::unique_ptr<Filter> make_hex_filter();
std::unique_ptr<Filter> make_check_filter();
std::unique_ptr<Filter> make_label_filter();
std::unique_ptr<Filter> make_block_filter();
std::unique_ptr<Filter> make_example_filter();
