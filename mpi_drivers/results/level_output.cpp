#include "mpi_drivers/results/level_output.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "io/data_files/label_file.hpp"
#include "solvers/partition/part_levels.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The pieces of one mesh's patches, with what of the mesh each has of each part.
class MeshPieces {
  public:
    MeshPieces(const MeshDescription& mesh, const PatchNumbering& numbering, const CutResult& cut)
        : mesh_(mesh), numbering_(numbering), cut_(cut), part_of_piece_(labels_of_parts(cut)) {
        area_.assign(at(cut.tree.finest()), 0.0);
        for (std::size_t f = 0; f < mesh.map.input_face.size(); ++f) {
            for (std::size_t s = 0; s < mesh.patches.size(); ++s)
                area_[at(piece(s, f))] += mesh.geometry.area[static_cast<Eigen::Index>(f)];
        }
    }

    /// Of each input face.
    [[nodiscard]] std::vector<int> of_faces(const std::vector<int>& part_of_input_face) const {
        std::vector<int> itself(mesh_.map.input_face.size());
        std::iota(itself.begin(), itself.end(), 0);
        const std::vector<int> working = carry_labels_back(mesh_.map, itself, mesh_.geometry.area);
        std::vector<int> pieces;
        for (std::size_t f = 0; f < working.size(); ++f)
            pieces.push_back(piece_of_face(at(working[f]), part_of_input_face[f]));
        return pieces;
    }

  private:
    static std::vector<int> labels_of_parts(const CutResult& cut) {
        return labels_at_level(cut.tree, static_cast<int>(cut.part_share.size()));
    }
    [[nodiscard]] int piece(std::size_t s, std::size_t working_face) const {
        return cut_.tree.piece_of_patch[at(numbering_.first(mesh_.mesh, static_cast<int>(s)) +
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
    const CutResult& cut_;
    std::vector<int> part_of_piece_;
    std::vector<double> area_;  ///< of each piece in the mesh, over all over-segmentations
};

void make_folder(const std::string& path) {
    std::error_code cause;
    std::filesystem::create_directories(path, cause);
    if (cause) throw Error(ExitCode::output, path + ": the folder cannot be made (" + cause.message() + ")");
}

}  // namespace

void write_levels(const Comm& comm, const std::string& folder, const Collection& collection,
                  const CutResult& cut, const std::vector<MeshLabels>& labels) {
    if (cut.tree.empty()) return;
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const std::vector<int> pieces =
                MeshPieces(mesh, collection.numbering, cut).of_faces(labels[k].part);
            for (int count = 2; count <= cut.tree.finest(); ++count) {
                const std::vector<int> label_of_piece = labels_at_level(cut.tree, count);
                std::vector<int> of_faces;
                for (const int piece : pieces) of_faces.push_back(label_of_piece[at(piece)]);
                const std::string level = folder + "/levels/" + std::to_string(count);
                make_folder(level);
                write_labels(level + "/" + collection.meshes[at(mesh.mesh)].name + ".seg", of_faces);
            }
        }
    });
}

}  // namespace coseg
