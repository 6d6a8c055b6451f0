#pragma once
// Every failure of the interface for other programs is one exception, coseg::Failure.

#include <coseg/shapes.hpp>

namespace coseg {

/// Throws the exception of the interface for the one under way. What is none of ours stays as it is.
[[noreturn]] void throw_failure();

/// Runs `work`; what it throws is that of the interface.
template <class Work>
auto with_failures(Work&& work) {
    try {
        return work();
    } catch (...) {
        throw_failure();
    }
}

}  // namespace coseg
