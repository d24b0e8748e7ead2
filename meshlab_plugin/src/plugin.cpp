#include "plugin.h"

#include <new>

namespace {

const char* const kCitation =
    "<br><br><i>G. Cherchi, M. Livesu, R. Scateni</i><br><b>\"Polycube Simplification for Coarse Layouts of "
    "Surfaces and Volumes\"</b><br>Computer Graphics Forum 35(5), 2016";

/// Progress of the core as MeshLab's percent.
polycube::Context make_context(vcg::CallBackPos* progress) {
    if (progress == nullptr) return polycube::Context();
    return polycube::Context([progress](const char* stage, double part) {
        const std::string text = std::string("Polycube: ") + stage;
        return progress(int(100.0 * part), text.c_str());
    });
}

/// Runs `work`; whatever it throws becomes a text for the user, empty if all went well.
template <class Work>
std::string text_of_failure(const Work& work) {
    try {
        work();
        return {};
    } catch (const std::bad_alloc&) {
        return "There is not enough memory for this. Choose a coarser mesh.";
    } catch (const std::exception& error) {
        return *error.what() != '\0' ? error.what() : "An unknown error occurred.";
    } catch (...) {
        return "An unknown error occurred.";
    }
}

}  // namespace

std::vector<std::unique_ptr<Filter>> make_filters() {
    std::vector<std::unique_ptr<Filter>> filters;
    filters.push_back(make_simplify_filter());
    filters.push_back(make_layout_filter());
    filters.push_back(make_quad_filter());
    filters.push_back(make_hex_filter());
    filters.push_back(make_check_filter());
    filters.push_back(make_label_filter());
    filters.push_back(make_block_filter());
    filters.push_back(make_example_filter());
    return filters;
}

PolycubePlugin::PolycubePlugin() : filters_(make_filters()) {
    for (std::size_t id = 0; id < filters_.size(); ++id) {
        typeList.push_back(host::FilterId(id));
        actionList.push_back(new QAction(filters_[id]->name(), this));
    }
}

QString PolycubePlugin::filterName(host::FilterId id) const { return filter(id).name(); }

QString PolycubePlugin::filterInfo(host::FilterId id) const { return filter(id).help() + kCitation; }

host::Arity PolycubePlugin::filterArity(host::Action* action) const { return filter(action).arity(); }

int PolycubePlugin::getPreConditions(host::Action* action) const {
    return filter(action).arity() == NONE ? MeshModel::MM_NONE : MeshModel::MM_FACENUMBER;
}

int PolycubePlugin::postCondition(host::Action* action) const { return filter(action).changes(); }

void PolycubePlugin::propose(const Filter& filter, const MeshDocument& document, RichParameterList& parameters) {
    const std::string failure = text_of_failure([&] { filter.add_parameters(document, parameters); });
    if (!failure.empty()) write_log("Error: " + failure);
}

host::Values PolycubePlugin::run(const Filter& filter, const RichParameterList& parameters, MeshDocument& document,
                                 vcg::CallBackPos* progress) {
    const polycube::Context context = make_context(progress);
    return filter.apply({parameters, document, context, [this](const std::string& line) { write_log(line); }});
}

#if POLYCUBE_MESHLAB_2020

void PolycubePlugin::write_log(const std::string& line) { Log(line); }

void PolycubePlugin::initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) {
    propose(filter(action), document, parameters);
}

bool PolycubePlugin::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                                 vcg::CallBackPos* progress) {
    const std::string failure = text_of_failure([&] { run(filter(action), parameters, document, progress); });
    if (failure.empty()) return true;
    errorMessage = QString::fromStdString(failure);
    // meshlabserver shows the log only.
    write_log("Error: " + failure);
    return false;
}

#else

void PolycubePlugin::write_log(const std::string& line) { log(line); }

QString PolycubePlugin::pythonFilterName(host::FilterId id) const { return filter(id).python_name(); }

RichParameterList PolycubePlugin::initParameterList(const QAction* action, const MeshDocument& document) {
    RichParameterList parameters;
    propose(filter(action), document, parameters);
    return parameters;
}

host::Values PolycubePlugin::applyFilter(const QAction* action, const RichParameterList& parameters,
                                         MeshDocument& document, unsigned int& post_condition,
                                         vcg::CallBackPos* progress) {
    post_condition = unsigned(filter(action).changes());
    host::Values values;
    const std::string failure = text_of_failure([&] { values = run(filter(action), parameters, document, progress); });
    if (!failure.empty()) throw MLException(QString::fromStdString(failure));
    return values;
}

#endif
