#pragma once
// What the benchmarks that run under mpirun share: MPI from start to end, and options.

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace coseg {

/// Calls run() after the options have been read. Returns the exit code.
template <class Run>
int parse_and_run(CLI::App& app, int argc, char** argv, Run&& run) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    }
    run();
    return 0;
}

/// program(argc, argv) between MPI_Init and MPI_Finalize; what it throws is printed and ends with 1.
template <class Program>
int run_with_mpi(int argc, char** argv, Program&& program) {
    MPI_Init(&argc, &argv);
    int status = 1;
    try {
        status = program(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    MPI_Finalize();
    return status;
}

}  // namespace coseg
