#include "io/interface/failures.hpp"

#include <new>

#include "src/base/error.hpp"

namespace coseg {

void throw_failure() {
    try {
        throw;
    } catch (const Error& error) {
        throw Failure(static_cast<int>(error.code()), error.what());
    } catch (const std::bad_alloc&) {
        throw Failure(static_cast<int>(ExitCode::internal), "out of memory; give fewer or coarser shapes");
    }
}

}  // namespace coseg
