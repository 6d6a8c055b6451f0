#pragma once
// A counter from which all ranks draw: the dynamic schedule of work items of unequal size.

#include <mpi.h>

#include <cstdint>

#include "src/parallel/comm.hpp"

namespace coseg {

/// next() gives 0, 1, 2, ..., each to exactly one caller, in the order in which ranks ask. It is one-sided:
/// no rank waits for another, though across nodes rank 0 may answer only while it is inside MPI. Construction
/// and destruction are collective. Where MPI cannot make its window, each rank that finds out throws
/// Error(internal) by itself, since others may wait in the same call for ever.
class SharedCounter {
  public:
    explicit SharedCounter(const Comm& comm);
    ~SharedCounter();
    SharedCounter(const SharedCounter&) = delete;
    SharedCounter& operator=(const SharedCounter&) = delete;

    [[nodiscard]] std::int64_t next();

    /// Makes next() give at least `exhausted` from now on. By this a rank tells the others to stop.
    void exhaust();
    [[nodiscard]] bool is_exhausted();
    static constexpr std::int64_t exhausted = std::int64_t{1} << 48;

  private:
    std::int64_t fetch_and_add(std::int64_t addend);
    int ranks_;
    MPI_Win window_ = MPI_WIN_NULL;
    std::int64_t* value_ = nullptr;
};

}  // namespace coseg
