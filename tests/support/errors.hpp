#pragma once
// What a call threw, for tests of messages.

#include <string>
#include <utility>

#include "src/base/error.hpp"

namespace coseg::test {

struct Caught {
    bool threw = false;
    ExitCode code = ExitCode::success;
    std::string sentence;
};

template <typename Call>
Caught error_of(Call call) {
    try {
        std::forward<Call>(call)();
    } catch (const Error& error) {
        return {true, error.code(), error.what()};
    }
    return {};
}

}  // namespace coseg::test
