#include <polycube/context.hpp>

#include "bridge.hpp"

namespace polycube {

Context::Context() : Context(Progress()) {}

Context::Context(Progress progress) : state_(std::make_shared<State>()) { state_->callback = std::move(progress); }

void Context::cancel() const noexcept { state_->cancelled = true; }

bool Context::is_cancelled() const noexcept { return state_->cancelled; }

double Context::progress() const noexcept { return state_->progress; }

namespace internal {

bool Listener::report(rust::Str stage, double progress) const noexcept {
    state_.progress = progress;
    if (!state_.callback) return true;
    try {
        if (state_.callback(std::string(stage).c_str(), progress)) return true;
    } catch (...) {
        thrown_ = std::current_exception();
    }
    state_.cancelled = true;
    return false;
}

void Listener::rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
}

}  // namespace internal
}  // namespace polycube
