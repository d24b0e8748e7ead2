/// @file
/// Progress out of a call, and cancellation into it.
#pragma once

#include <functional>
#include <memory>

namespace polycube {

/// Carries progress out of and cancellation into a call. Copies share both. Cancellation is sticky: a cancelled context
/// stops every later call it is given to.
///
/// @code
/// polycube::Context context([](const char* stage, double progress) {
///     std::clog << stage << ' ' << progress << '\n';
///     return progress < 0.5;  // false stops the call, as `context.cancel()` does from another thread
/// });
/// try {
///     polycube::simplify({cube, shape}, {}, context);
/// } catch (const polycube::Error& error) {
///     if (error.kind() != polycube::ErrorKind::cancelled) throw;
/// }
/// @endcode
class Context {
 public:
    /// Called with the name of the stage and the progress in [0, 1], which never decreases; returns whether to go on.
    ///
    /// It runs on the thread that made the call and on no other, at most some hundred times a second. An exception that
    /// it throws cancels the call and leaves the call in place of the `Error`.
    using Progress = std::function<bool(const char* stage, double progress)>;

    /// A context that nobody listens to.
    Context();
    /// A context that reports to `progress`.
    explicit Context(Progress progress);

    /// Asks every call that has this context to stop; such a call throws an `Error` of `ErrorKind::cancelled` within
    /// 100 ms on meshes of 30,000 hexahedra and has changed nothing. Safe from any thread, and from a signal handler.
    void cancel() const noexcept;
    /// Whether `cancel` was called or `Progress` returned false.
    bool is_cancelled() const noexcept;
    /// The progress reported last, in [0, 1]. Safe from any thread.
    double progress() const noexcept;

    struct State;
    /// For the library itself.
    State& state() const noexcept { return *state_; }

 private:
    std::shared_ptr<State> state_;
};

}  // namespace polycube
