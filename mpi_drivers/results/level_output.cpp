#include "mpi_drivers/results/level_output.hpp"

#include <algorithm>

#include "io/data_files/label_file.hpp"
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

/// labels_at_level of each level, from 2 parts on.
std::vector<std::vector<int>> labels_of_levels(const PartTree& tree) {
    std::vector<std::vector<int>> levels;
    for (int count = 2; count <= tree.finest(); ++count) levels.push_back(labels_at_level(tree, count));
    return levels;
}

}  // namespace

void write_levels(const Comm& comm, const std::string& folder, const Collection& collection,
                  const CutResult& cut, const std::vector<MeshLabels>& labels) {
    if (cut.tree.empty()) return;
    const std::vector<std::vector<int>> levels = labels_of_levels(cut.tree);
    const std::vector<int>& part_of_piece = levels[cut.part_share.size() - 2];
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const std::vector<int> pieces =
                MeshPieces(mesh, collection.numbering, cut.tree, part_of_piece).of_faces(labels[k].part);
            for (std::size_t level = 0; level < levels.size(); ++level) {
                std::vector<int> of_faces;
                for (const int piece : pieces) of_faces.push_back(levels[level][at(piece)]);
                const std::string path = folder + "/levels/" + std::to_string(level + 2) + "/" +
                                         collection.meshes[at(mesh.mesh)].name + ".seg";
                make_parent_folders(path);
                write_labels(path, of_faces);
            }
        }
    });
}

}  // namespace coseg
