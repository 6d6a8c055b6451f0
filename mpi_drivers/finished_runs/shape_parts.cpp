#include "mpi_drivers/finished_runs/shape_parts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "io/data_files/name_file.hpp"
#include "src/base/index.hpp"
#include "src/measures/part_pieces.hpp"
#include "src/measures/piece_numbers.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/repair/mesh_repair.hpp"

namespace coseg {

namespace {

/// The pieces of one shape of this rank.
struct ShapePieces {
    PartSurface surface;
    std::vector<int> piece;  ///< per triangle
    std::vector<PartPiece> pieces;
};

ShapePieces pieces_of(const LabelledMesh& shape) {
    ShapePieces found;
    found.surface = part_surface(shape);
    found.piece = part_pieces(found.surface.mesh, found.surface.part);
    TriMesh standing = found.surface.mesh;
    standing.vertices = shape.rotation * standing.vertices;
    found.pieces = pieces_of_shape(shape.number, standing, found.surface.part, found.piece);
    return found;
}

/// A face without a triangle takes the number of another face; where that is of another part, the lowest
/// number of its own.
std::vector<int> numbers_of_faces(const LabelledMesh& shape, const ShapePieces& found,
                                  const std::vector<int>& number_of_piece) {
    std::vector<int> working;
    for (const int piece : found.piece) working.push_back(number_of_piece[at(piece)]);
    const Eigen::VectorXd areas = face_geometry(found.surface.mesh).area;
    std::vector<int> numbers = carry_labels_back(found.surface.map, working, areas);
    std::map<int, std::vector<int>> numbers_of_part;
    for (std::size_t k = 0; k < found.pieces.size(); ++k)
        numbers_of_part[found.pieces[k].part].push_back(number_of_piece[k]);
    for (std::size_t f = 0; f < numbers.size(); ++f) {
        const std::vector<int>& of_part = numbers_of_part[shape.part[f]];
        if (std::find(of_part.begin(), of_part.end(), numbers[f]) != of_part.end()) continue;
        numbers[f] = of_part.empty() ? 1 : *std::min_element(of_part.begin(), of_part.end());
    }
    return numbers;
}

}  // namespace

PartSurface part_surface(const LabelledMesh& shape) {
    RepairedMesh repaired = repair(shape.mesh, shape.name);
    PartSurface surface{std::move(repaired.mesh), std::move(repaired.map), {}};
    for (const int face : surface.map.input_face) surface.part.push_back(shape.part[at(face)]);
    return surface;
}

std::vector<std::string> names_of_parts(const Comm& comm, const FinishedRun& run,
                                        const std::vector<LabelledMesh>& shapes, const FinishedInput& input,
                                        const std::string& file) {
    LabelNames names;
    bool are_of_labels = false;
    agree(comm, [&] {
        names = file.empty() ? names_in_folder(run.folder) : read_names(file);
        if (!file.empty()) refuse_names_beyond(names, run.parts, file);
        if (!names.empty()) return;
        names = names_beside_truth(input.truth);
        are_of_labels = !names.empty();
    });
    are_of_labels = any_rank(comm, are_of_labels);
    std::vector<int> label_of_part;
    if (are_of_labels) label_of_part = agree_on_truth(comm, shapes, run.parts);
    std::vector<std::string> of_parts;
    for (int part = 0; part < run.parts; ++part) {
        const auto found = names.find(are_of_labels ? label_of_part[at(part)] : part);
        of_parts.push_back(found != names.end() ? found->second : "part_" + std::to_string(part));
    }
    return of_parts;
}

std::vector<std::vector<int>> instances_of(const Comm& comm, const std::vector<LabelledMesh>& shapes) {
    std::vector<ShapePieces> found;
    std::vector<PartPiece> local;
    agree(comm, [&] {
        for (const LabelledMesh& shape : shapes) {
            found.push_back(pieces_of(shape));
            local.insert(local.end(), found.back().pieces.begin(), found.back().pieces.end());
        }
    });
    const std::vector<PartPiece> pieces = all_gather_records(comm, local);
    const std::vector<int> numbers = piece_numbers(pieces);
    std::map<int, std::vector<int>> numbers_of_shape;  // pieces of a shape are of one rank and in their order
    for (std::size_t k = 0; k < pieces.size(); ++k) numbers_of_shape[pieces[k].shape].push_back(numbers[k]);
    std::vector<std::vector<int>> instances;
    agree(comm, [&] {
        for (std::size_t k = 0; k < shapes.size(); ++k)
            instances.push_back(numbers_of_faces(shapes[k], found[k], numbers_of_shape[shapes[k].number]));
    });
    return instances;
}

}  // namespace coseg
