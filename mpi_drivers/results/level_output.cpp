#include "mpi_drivers/results/level_output.hpp"

#include <mpi.h>

#include <algorithm>
#include <utility>

#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/folders/state_folder.hpp"
#include "solvers/partition/part_levels.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The pieces of one mesh's patches, with what of the mesh each has of each part.
class MeshPieces {
  public:
    MeshPieces(const MeshDescription& mesh, const PatchNumbering& numbering, const PartTree& tree,
               const std::vector<int>& part_of_piece)
        : mesh_(mesh), numbering_(numbering), tree_(tree), part_of_piece_(part_of_piece) {
        area_.assign(part_of_piece.size(), 0.0);
        for (std::size_t f = 0; f < mesh.map.input_face.size(); ++f) {
            for (std::size_t s = 0; s < mesh.patches.size(); ++s)
                area_[at(piece(s, f))] += mesh.geometry.area[static_cast<Eigen::Index>(f)];
        }
    }

    /// Of each input face.
    [[nodiscard]] std::vector<int> of_faces(const std::vector<int>& part_of_input_face) const {
        const std::vector<int> working = main_working_faces(mesh_.map, mesh_.geometry.area);
        std::vector<int> pieces;
        for (std::size_t f = 0; f < working.size(); ++f)
            pieces.push_back(piece_of_face(at(working[f]), part_of_input_face[f]));
        return pieces;
    }

  private:
    [[nodiscard]] int piece(std::size_t s, std::size_t working_face) const {
        return tree_.piece_of_patch[at(numbering_.first(mesh_.mesh, static_cast<int>(s)) +
                                       mesh_.patches[s][working_face])];
    }

    [[nodiscard]] int piece_of_face(std::size_t working_face, int part) const {
        std::vector<int> votes(area_.size(), 0);
        for (std::size_t s = 0; s < mesh_.patches.size(); ++s) ++votes[at(piece(s, working_face))];
        int best = part;  // the piece that leads the part
        for (int p = 0; p < static_cast<int>(votes.size()); ++p) {
            if (part_of_piece_[at(p)] != part) continue;
            const bool has_more = votes[at(p)] > votes[at(best)];
            if (has_more || (votes[at(p)] == votes[at(best)] && area_[at(p)] > area_[at(best)])) best = p;
        }
        return best;
    }

    const MeshDescription& mesh_;
    const PatchNumbering& numbering_;
    const PartTree& tree_;
    const std::vector<int>& part_of_piece_;
    std::vector<double> area_;  ///< of each piece in the mesh, over all over-segmentations
};

/// The parts of a level that is written, of each piece.
struct WrittenLevel {
    int parts = 0;
    std::vector<int> label_of_piece;  ///< -1 of pieces without a face
};

/// 1 for each piece that a face of any mesh has. Collective.
std::vector<int> pieces_with_faces(const Comm& comm, const std::vector<std::vector<int>>& pieces_of_faces,
                                   std::size_t pieces) {
    std::vector<int> found(pieces, 0);
    for (const std::vector<int>& of_mesh : pieces_of_faces) {
        for (const int piece : of_mesh) found[at(piece)] = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, found.data(), static_cast<int>(pieces), MPI_INT, MPI_MAX, comm.raw());
    return found;
}

/// The level with `count` parts of the tree, with numbers for those parts alone that have a face.
WrittenLevel level_of_faces(const PartTree& tree, int count, const std::vector<int>& has_faces) {
    WrittenLevel level{0, labels_at_level(tree, count)};
    std::vector<int> number(at(count), -1);
    for (std::size_t p = 0; p < has_faces.size(); ++p) {
        if (has_faces[p] != 0) number[at(level.label_of_piece[p])] = 0;
    }
    for (int& n : number) {
        if (n == 0) n = level.parts++;
    }
    for (int& label : level.label_of_piece) label = number[at(label)];
    return level;
}

/// One level for each number of parts that have faces: that of the run's parts as it is, and of others with
/// the same number the coarsest.
std::vector<WrittenLevel> written_levels(const PartTree& tree, int parts, const std::vector<int>& has_faces) {
    std::vector<WrittenLevel> levels;
    for (int count = 2; count <= tree.finest(); ++count) {
        WrittenLevel level = count == parts ? WrittenLevel{parts, labels_at_level(tree, parts)}
                                            : level_of_faces(tree, count, has_faces);
        const bool is_new = std::none_of(levels.begin(), levels.end(), [&](const WrittenLevel& other) {
            return other.parts == level.parts;
        });
        if (count == parts || (is_new && level.parts >= 2 && level.parts != parts))
            levels.push_back(std::move(level));
    }
    return levels;
}

void write_level(const std::string& folder, const std::string& name, const WrittenLevel& level,
                 const std::vector<int>& pieces) {
    std::vector<int> labels;
    for (const int piece : pieces) labels.push_back(level.label_of_piece[at(piece)]);
    const std::string path =
        folder + "/" + result_files::levels + "/" + std::to_string(level.parts) + "/" + name + label_suffix;
    make_parent_folders(path);
    write_labels(path, labels);
}

}  // namespace

void write_levels(const Comm& comm, const std::string& folder, const Collection& collection,
                  const CutResult& cut, const std::vector<MeshLabels>& labels) {
    if (cut.tree.empty()) return;
    const auto parts = static_cast<int>(cut.part_share.size());
    const std::vector<int> part_of_piece = labels_at_level(cut.tree, parts);
    std::vector<std::vector<int>> pieces;
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k)
            pieces.push_back(MeshPieces(collection.local[k], collection.numbering, cut.tree, part_of_piece)
                                 .of_faces(labels[k].part));
    });
    const std::vector<WrittenLevel> levels =
        written_levels(cut.tree, parts, pieces_with_faces(comm, pieces, part_of_piece.size()));
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            for (const WrittenLevel& level : levels)
                write_level(folder, collection.meshes[at(collection.local[k].mesh)].name, level, pieces[k]);
        }
    });
}

}  // namespace coseg
