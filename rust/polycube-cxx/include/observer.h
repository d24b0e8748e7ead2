// What a call of the bridge asks of its caller while it runs. All of it happens on the caller's thread.
#pragma once

#include "rust/cxx.h"

namespace polycube::bridge {

class Observer {
   public:
    virtual ~Observer() = default;
    // Whether the call shall stop; asked about a hundred times a second.
    virtual bool is_cancelled() const noexcept = 0;
    // News of the progress in [0, 1]; returns whether to go on.
    virtual bool report(rust::Str stage, double progress) const noexcept = 0;
};

}  // namespace polycube::bridge
