// What it takes to read meshes from files in the page cache: bench/reading.py makes the files and drives
// this.
//
//   mesh_reading_bench MESH ...          JSON on standard output, one object a mesh
//
// Each mesh is read by a process of its own, so that the largest memory that it held is that of the one mesh.
// What the process held before it began to read is not counted.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <string>

#include "io/mesh_files/mesh_reader.hpp"

namespace {

/// A line "NAME: 1234 kB" of /proc/self/status, in MiB.
double status_mib(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
    }
    return 0.0;
}

/// Reading is the work of one thread, and files in the page cache are waited for by nobody: unlike seconds on
/// the clock, these do not depend on what else the machine does.
double cpu_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void print_reading(const std::string& path, const char* separator) {
    const double before = status_mib("VmRSS");
    const double start = cpu_seconds();
    const coseg::PolygonMesh mesh = coseg::read_mesh(path);
    const double seconds = cpu_seconds() - start;
    std::printf(
        "%s{\"file\": \"%s\", \"vertices\": %d, \"faces\": %d, \"seconds\": %.4f, \"peak_mib\": %.1f}",
        separator, path.c_str(), mesh.vertex_count(), mesh.face_count(), seconds,
        status_mib("VmHWM") - before);
    std::fflush(stdout);
}

/// False if the process that read the mesh failed.
bool read_apart(const std::string& path, const char* separator) {
    const pid_t child = ::fork();
    if (child == 0) {
        int status = 1;
        try {
            print_reading(path, separator);
            status = 0;
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
        ::_exit(status);
    }
    int status = 1;
    return child > 0 && ::waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: mesh_reading_bench MESH ...\n");
        return 2;
    }
    std::printf("[");
    std::fflush(stdout);
    for (int k = 1; k < argc; ++k) {
        if (!read_apart(argv[k], k > 1 ? ",\n " : "")) return 1;
    }
    std::printf("]\n");
    return 0;
}
