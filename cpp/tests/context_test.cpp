#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "helpers.hpp"

using polycube::Context;
using polycube::ErrorKind;
using polycube::Input;
using polycube::RemeshOptions;

namespace {

Input input() { return {pair().first, pair().second}; }

}  // namespace

TEST_CASE("progress grows, on the thread of the call, and ends at one") {
    const auto caller = std::this_thread::get_id();
    std::vector<std::string> stages;
    double last = 0.0;
    const Context context([&](const char* stage, double progress) {
        CHECK(std::this_thread::get_id() == caller);
        CHECK(progress >= last);
        CHECK(progress <= 1.0);
        last = progress;
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
        return true;
    });
    polycube::remesh(input(), coarse(), context);
    CHECK(last > 0.9);
    CHECK(context.progress() == last);
    CHECK(!context.is_cancelled());
    CHECK(stages.size() >= 3);
}

TEST_CASE("the callback cancels half-way, and the context stays cancelled") {
    int calls = 0;
    const Context context([&](const char*, double progress) {
        ++calls;
        return progress < 0.3;
    });
    CHECK(error_of([&] { polycube::remesh(input(), coarse(), context); }).kind() == ErrorKind::cancelled);
    CHECK(context.is_cancelled());
    CHECK(calls > 1);
    CHECK(error_of([&] { polycube::simplify(Input(box()), {}, context); }).kind() == ErrorKind::cancelled);
    CHECK(error_of([&] { polycube::check(Input(box()), {}, context); }).kind() == ErrorKind::cancelled);
}

TEST_CASE("another thread cancels half-way") {
    const Context context;
    std::thread other([&] {
        while (context.progress() < 0.2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        context.cancel();
    });
    RemeshOptions options = coarse();
    options.size->value = 20000.0;
    CHECK(error_of([&] { polycube::remesh(input(), options, context); }).kind() == ErrorKind::cancelled);
    other.join();
}

TEST_CASE("what the callback throws reaches the caller") {
    const Context context([](const char*, double) -> bool { throw std::out_of_range("enough"); });
    CHECK_THROWS_WITH_AS(polycube::simplify(input(), quick(), context), "enough", std::out_of_range);
    CHECK(context.is_cancelled());
    // Other things than exceptions, too.
    const Context odd([](const char*, double) -> bool { throw 7; });
    CHECK_THROWS_AS(polycube::simplify(input(), quick(), odd), int);
}

TEST_CASE("two threads at once get what one gets, and one may be cancelled") {
    const auto work = [](const Context& context) {
        return polycube::simplify(input(), quick(), context).polycube().points;
    };
    const std::vector<double> expected = work({});
    std::vector<double> a, b;
    std::atomic<bool> stopped{false};
    const Context cancelled([](const char*, double) { return false; });
    std::thread first([&] { a = work({}); });
    std::thread second([&] { b = work({}); });
    std::thread third([&] { stopped = error_of([&] { work(cancelled); }).kind() == ErrorKind::cancelled; });
    first.join();
    second.join();
    third.join();
    CHECK(a == expected);
    CHECK(b == expected);
    CHECK(stopped);
}

TEST_CASE("a context may be used again, and shared by copies") {
    const Context context;
    const Context copy = context;
    polycube::simplify(Input(box()), {}, context);
    polycube::simplify(Input(box()), {}, copy);
    copy.cancel();
    CHECK(context.is_cancelled());
}
