// The one entry and the one exit: parses the command line, runs a subcommand, and turns every failure into
// one sentence on rank 0 and a documented exit code on all ranks.

#include <malloc.h>
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>

#include "mpi_drivers/commands/command_line.hpp"
#include "mpi_drivers/process/mpi_start.hpp"
#include "mpi_drivers/process/self_launch.hpp"
#include "mpi_drivers/process/signals.hpp"
#include "src/base/error.hpp"

namespace {

using coseg::AgreedError;
using coseg::Comm;
using coseg::CommandLine;
using coseg::Error;
using coseg::ExitCode;

/// A failure that the other ranks do not know of: they may wait in a collective call, so all are ended here.
[[noreturn]] void end_all_ranks(int rank, const std::string& cause, ExitCode code) {
    std::fprintf(stderr, "coseg: rank %d: %s\n", rank, cause.c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    std::abort();
}

int run_command(const Comm& world, const CommandLine& line) {
    try {
        line.run(world);
        return static_cast<int>(ExitCode::success);
    } catch (const AgreedError& error) {
        return coseg::told(error, world.is_root());
    } catch (const Error& error) {
        if (world.size() == 1) return coseg::told(error, true);
        end_all_ranks(world.rank(), error.what(), error.code());
    } catch (const std::bad_alloc&) {
        end_all_ranks(world.rank(), "out of memory; use more nodes or fewer shapes", ExitCode::internal);
    } catch (const std::exception& error) {
        end_all_ranks(world.rank(), error.what(), ExitCode::internal);
    }
}

/// A result that could not be printed (a full disk, a closed pipe) is no success.
int with_output_written(int code) {
    std::cout.flush();
    if (std::cout.good() || code != static_cast<int>(ExitCode::success)) return code;
    std::fprintf(stderr, "coseg: standard output cannot be written; redirect it to where there is space\n");
    return static_cast<int>(ExitCode::output);
}

/// libpsm2, which Open MPI loads whether there is such a network or not, makes malloc keep what is freed, for
/// the sake of pinned pages: large arrays are then cut from one heap, which grows with every stage and never
/// shrinks.
void return_freed_memory() {
    constexpr int mebibyte = 1 << 20;
    mallopt(M_MMAP_MAX, 65536);  // glibc's own value
    mallopt(M_MMAP_THRESHOLD, 4 * mebibyte);
    mallopt(M_TRIM_THRESHOLD, 64 * mebibyte);
}

}  // namespace

// What is thrown outside a subcommand (out of memory at start) may end the program at once.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
    coseg::raise_stack_limit();
    CommandLine line(argc, argv);
    const bool is_alone = !coseg::is_launched();
    if (is_alone) {
        if (const std::optional<int> ended = line.parse()) return with_output_written(*ended);
        if (const auto request = line.launch_request()) coseg::launch_ranks(*request, argc, argv);
    }
    if (line.keeps_state()) coseg::heed_stop_requests();
    coseg::let_long_files_fail();
    coseg::initialise_mpi(MPI_THREAD_FUNNELED);  // threads that watch call no MPI
    return_freed_memory();
    int code = 0;
    {
        const Comm world(MPI_COMM_WORLD);
        const std::optional<int> ended = is_alone ? std::nullopt : line.parse(world);
        code = with_output_written(ended ? *ended : run_command(world, line));
    }
    MPI_Finalize();
    return code;
}
