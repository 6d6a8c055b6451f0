// Reads two meshes, prints the mean shape diameter of each, cuts both into the same two parts in memory, and
// writes the labels of the second as text. After `cmake --install` of coseg, build and run this example with:
//     cmake -S . -B build && cmake --build build && build/two_meshes A.off B.off
// Under `mpirun -n 2` the two processes share the work.
#include <mpi.h>

#include <coseg/coseg.hpp>
#include <cstdio>
#include <vector>

namespace {

double mean_diameter(const coseg::ShapeDescription& shape) {
    double sum = 0.0;
    double area = 0.0;
    for (const coseg::NamedFaceValues& descriptor : shape.descriptors) {
        if (descriptor.name != "shape_diameter") continue;
        for (std::size_t f = 0; f < shape.areas.size(); ++f) {
            sum += shape.areas[f] * descriptor.values[f];
            area += shape.areas[f];
        }
    }
    return sum / area;
}

void cut(const char* a, const char* b, bool prints) {
    const MPI_Comm world = MPI_COMM_WORLD;
    const coseg::Call call{.communicator = &world, .progress = {}};
    // The first shape is a file, and the second is in memory: any program's own mesh would do.
    const coseg::Mesh mesh = coseg::load_mesh(b);
    const std::vector<coseg::Shape> shapes = {coseg::shape_of(a), coseg::shape_of(mesh, "b")};
    for (const coseg::ShapeDescription& shape : coseg::describe(shapes, {}, call)) {
        if (prints) std::printf("%s: mean shape diameter %.3f\n", shape.name.c_str(), mean_diameter(shape));
    }
    coseg::SegmentOptions options;
    options.parts = 2;
    options.options = {{"patches", "30"}};
    const coseg::Segmentation result = coseg::segment(shapes, options, call);
    if (!prints) return;
    std::printf("certified gap %.1e\n", result.certificate.relative_gap);
    std::FILE* file = std::fopen("b.seg", "w");
    if (file == nullptr) return;
    for (const int part : result.shapes[1].labels) std::fprintf(file, "%d\n", part);
    std::fclose(file);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: two_meshes A B\n", stderr);
        return 2;
    }
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int code = 0;
    try {
        cut(argv[1], argv[2], rank == 0);
    } catch (const coseg::Failure& failure) {
        // Every rank has the same failure, so that all can end in order.
        if (rank == 0) std::fprintf(stderr, "two_meshes: %s\n", failure.what());
        code = failure.code();
    }
    MPI_Finalize();
    return code;
}
