// Reads two meshes, prints the mean shape diameter of each, and cuts both into the same two parts. The labels
// are written to two_meshes_result/labels. After `cmake --install` of coseg, build and run this example with:
//     cmake -S . -B build && cmake --build build && build/two_meshes A.off B.off
#include <mpi.h>

#include <cstdio>

#include "io/mesh_files/mesh_reader.hpp"
#include "mpi_drivers/co_segmentation.hpp"
#include "src/descriptors/shape_diameter.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/repair/mesh_repair.hpp"

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    MPI_Init(&argc, &argv);
    {
        // A Comm frees its communicator, so that it has to go out of scope before MPI_Finalize.
        const coseg::Comm world(MPI_COMM_WORLD);
        for (const char* path : {argv[1], argv[2]}) {
            // A file may hold polygons, seams or degenerate faces. repair makes a clean triangle mesh of it.
            const coseg::TriMesh mesh = coseg::repair(coseg::read_mesh(path), path).mesh;
            const coseg::FaceGeometry geometry = coseg::face_geometry(mesh);
            const Eigen::VectorXd thickness =
                coseg::shape_diameter(mesh, geometry, coseg::dual_graph(mesh, geometry));
            if (world.is_root()) std::printf("%s: mean shape diameter %.3f\n", path, thickness.mean());
        }
        coseg::RunOptions options;
        options.process.inputs = {argv[1], argv[2]};
        options.partition.parts = 2;
        options.output.folder = "two_meshes_result";
        options.output.force = true;
        coseg::co_segment(world, options);
    }
    MPI_Finalize();
}
