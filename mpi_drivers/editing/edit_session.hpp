#pragma once
// The session of a person who corrects a run: takes acts, and gives the labels that follow. It knows nothing
// of pages and servers.

#include <memory>
#include <string>
#include <vector>

#include "io/data_files/correction_file.hpp"
#include "mpi_drivers/editing/corrected_cut.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "solvers/partition/open_questions.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// A region of a shape that contains a face.
enum class FaceRegion {
    face,   ///< the face alone
    patch,  ///< its patch of the first over-segmentation
    piece,  ///< all faces of its part that hang together with it
};
constexpr std::array<EnumName<FaceRegion>, 3> enum_names(FaceRegion /*type*/) {
    return {{{FaceRegion::face, "face"}, {FaceRegion::patch, "patch"}, {FaceRegion::piece, "piece"}}};
}

/// Every act leads to the labels that the list of all acts gives from the run's own partition. What was done
/// and undone before does not count, so that a file of corrections says all. All functions are collective but
/// those that say otherwise, and throw AgreedError; the session is then as it was before.
class EditSession {
  public:
    /// What `base` refers to must outlive this. path: the file of acts, which is read if it is there. Throws
    /// AgreedError(input) where it is of another run, or its acts cannot be followed; AgreedError(output)
    /// where it cannot be written.
    EditSession(const Comm& comm, const CorrectionBase& base, std::unique_ptr<CorrectedParts> parts,
                RefineMode refine, std::string path);

    /// Does one act more; what was undone cannot be done again any more.
    void act(Correction correction);
    /// Takes the last act back, or does it again. Throws AgreedError(usage) where there is none.
    void undo();
    void redo();

    /// Acts from a region that contains a face: label it, or confirm the shape as it is shown.
    Correction label_of_region(int mesh, int face, FaceRegion region, int part);
    Correction confirmation_of(int mesh);

    /// The labels of faces, on all ranks.
    MeshLabels labels(int mesh);
    /// Writes FOLDER/NAME.seg of all shapes.
    void write_all_labels(const std::string& folder);

    // What follows is the same on all ranks, and not collective.

    [[nodiscard]] const CorrectionState& state() const noexcept { return now_->state; }
    [[nodiscard]] const CutResult& cut() const noexcept { return now_->corrected.cut; }
    [[nodiscard]] const std::vector<Correction>& acts() const noexcept { return file_.acts; }
    [[nodiscard]] const std::vector<Correction>& undone() const noexcept { return file_.undone; }
    /// How often something was done: a page tells by it whether it shows what is.
    [[nodiscard]] int revision() const noexcept { return revision_; }
    /// Shapes of which a patch has another part, or something else is said, than before the last act.
    [[nodiscard]] const std::vector<int>& changed() const noexcept { return changed_; }
    [[nodiscard]] const std::vector<OpenQuestion>& questions() const noexcept { return questions_; }
    [[nodiscard]] int next() const { return next_question(questions_, state().confirmed()); }
    /// Of each mesh, the mean over its area of the probability that the part is right.
    [[nodiscard]] std::vector<double> confidence() const;

  private:
    /// Where all acts lead.
    struct Now {
        CorrectionState state;
        CorrectedCut corrected;
    };
    [[nodiscard]] Now now_after(const std::vector<Correction>& acts) const;
    void take(CorrectionFile file);
    void find_changes(const Now& next);
    const MeshLabels& local_labels(std::size_t k);

    const Comm& comm_;
    CorrectionBase base_;
    std::unique_ptr<CorrectedParts> parts_;
    RefineMode refine_;
    std::string path_;
    CorrectionFile file_;
    std::unique_ptr<Now> now_;
    std::vector<int> changed_;
    std::vector<OpenQuestion> questions_;
    /// Of collection.local; null where they are to be found.
    std::vector<std::unique_ptr<MeshLabels>> local_;
    int revision_ = 0;
};

}  // namespace coseg
