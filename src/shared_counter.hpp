#pragma once
// A counter that all ranks draw from: the dynamic schedule of work items of unequal size.

#include <mpi.h>

#include <cstdint>

#include "src/comm.hpp"

namespace coseg {

/// next() gives 0, 1, 2, ... each to exactly one caller, in the order in which ranks ask. One-sided: no rank waits for
/// another, though across nodes rank 0 may answer only while it is inside MPI. Construction and destruction are collective.
class SharedCounter {
  public:
    explicit SharedCounter(const Comm& comm);
    ~SharedCounter();
    SharedCounter(const SharedCounter&) = delete;
    SharedCounter& operator=(const SharedCounter&) = delete;

    [[nodiscard]] std::int64_t next();

  private:
    MPI_Win window_ = MPI_WIN_NULL;
    std::int64_t* value_ = nullptr;
};

}  // namespace coseg
