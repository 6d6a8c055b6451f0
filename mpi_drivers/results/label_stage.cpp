#include "mpi_drivers/results/label_stage.hpp"

#include <algorithm>
#include <utility>

#include "solvers/boundaries/fuzzy_cut.hpp"
#include "src/base/index.hpp"
#include "src/patches/face_labels.hpp"

namespace coseg {

namespace {

std::vector<std::vector<int>> parts_of_mesh(const PatchNumbering& numbering, int mesh,
                                            const std::vector<int>& part_of_patch) {
    std::vector<std::vector<int>> parts;
    for (int s = 0; s < numbering.oversegmentations(); ++s) {
        const auto first = part_of_patch.begin() + numbering.first(mesh, s);
        parts.emplace_back(first, first + numbering.count(mesh, s));
    }
    return parts;
}

/// Of the parts as the faces of the file have them: a part that no face of the file took has no share.
std::vector<double> area_shares(const MeshDescription& mesh, const std::vector<int>& part_of_input_face,
                                int parts) {
    std::vector<double> share(static_cast<std::size_t>(parts), 0.0);
    for (std::size_t f = 0; f < mesh.map.input_face.size(); ++f) {
        const int part = part_of_input_face[at(mesh.map.input_face[f])];
        share[at(part)] += mesh.geometry.area[static_cast<Eigen::Index>(f)];
    }
    for (double& of_part : share) of_part = std::min(of_part, 1.0);  // areas sum to 1 but for rounding
    return share;
}

/// Of input faces, each by the working face that has most of it, or that it takes its part from.
std::vector<float> confidence_of_faces(const MeshDescription& mesh, const PatchNumbering& numbering,
                                       const CutResult& cut, const std::vector<int>& part_of_input_face,
                                       int parts) {
    if (cut.confidence.empty() || parts < 2) return {};
    const std::vector<int> working = main_working_faces(mesh.map, mesh.geometry.area);
    std::vector<float> confidence;
    for (std::size_t f = 0; f < working.size(); ++f) {
        double sum = 0.0;
        for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
            const auto patch =
                at(numbering.first(mesh.mesh, static_cast<int>(s)) + mesh.patches[s][at(working[f])]);
            const bool agrees = cut.part_of_patch[patch] == part_of_input_face[f];
            sum += agrees ? cut.confidence[patch] : (1.0 - cut.confidence[patch]) / (parts - 1);
        }
        confidence.push_back(static_cast<float>(sum / static_cast<double>(mesh.patches.size())));
    }
    return confidence;
}

/// `given`: empty, or -1 where nothing is said.
void keep_given(const std::vector<int>& given, std::vector<int>& part_of_input_face,
                std::vector<float>& confidence) {
    for (std::size_t f = 0; f < given.size(); ++f) {
        if (given[f] < 0) continue;
        part_of_input_face[f] = given[f];
        if (!confidence.empty()) confidence[f] = 1.0F;
    }
}

/// How far a crease may draw a boundary, in units of sqrt(area of the mesh): a sixth of the side of a patch.
constexpr double crease_reach = 0.025;
/// How far scores may: two thirds of the side of a patch.
constexpr double score_reach = 0.1;
/// Of the scores against the length of boundaries, see score_costs.
constexpr double score_weight = 20.0;
/// Triangles from a boundary that scores may move. The reach ends most moves long before.
constexpr int score_strip = 60;

/// K x faces: the mean over the over-segmentations of the scores of the face's patches, or empty.
Eigen::MatrixXd scores_of_faces(const MeshDescription& mesh, const PatchNumbering& numbering,
                                const Eigen::MatrixXf& of_patches) {
    if (of_patches.size() == 0) return {};
    const auto faces = static_cast<Eigen::Index>(mesh.patches.front().size());
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(of_patches.rows(), faces);
    for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
        const int first = numbering.first(mesh.mesh, static_cast<int>(s));
        for (Eigen::Index f = 0; f < faces; ++f)
            scores.col(f) += of_patches.col(first + mesh.patches[s][at(f)]).cast<double>();
    }
    return scores / static_cast<double>(mesh.patches.size());
}

std::vector<int> refined(const DualGraph& graph, const FaceGeometry& geometry, const Eigen::MatrixXd& scores,
                         const std::vector<int>& part_of_face, int parts, RefineMode refinement) {
    const auto holding = [&](double reach) {
        return holding_costs(graph, geometry, part_of_face, parts, reach);
    };
    if (refinement == RefineMode::none) return part_of_face;
    if (refinement == RefineMode::fuzzy) return fuzzy_cut(graph, part_of_face);
    if (refinement == RefineMode::held || scores.size() == 0)
        return fuzzy_cut(graph, part_of_face, {}, holding(crease_reach));
    return fuzzy_cut(graph, part_of_face, {.strip_width = score_strip},
                     holding(score_reach) + score_weight * score_costs(graph, geometry, scores));
}

}  // namespace

MeshLabels labels_of_mesh(const MeshDescription& mesh, const PatchNumbering& numbering, const CutResult& cut,
                          int parts, RefineMode refine, const std::vector<int>& given) {
    const auto part_of = parts_of_mesh(numbering, mesh.mesh, cut.part_of_patch);
    DualGraph graph = mesh.graph;
    index_incidence(graph);
    Eigen::MatrixXd scores;
    if (refine == RefineMode::scored) scores = scores_of_faces(mesh, numbering, cut.scores);
    const std::vector<int> part_of_face = refined(
        graph, mesh.geometry, scores, vote_face_labels(mesh.patches, part_of, parts, graph), parts, refine);
    std::vector<int> part = carry_labels_back(mesh.map, part_of_face, mesh.geometry.area);
    std::vector<float> confidence = confidence_of_faces(mesh, numbering, cut, part, parts);
    keep_given(given, part, confidence);
    std::vector<double> part_area = area_shares(mesh, part, parts);
    return {.mesh = mesh.mesh,
            .part = std::move(part),
            .patch = carry_labels_back(mesh.map, mesh.patches.front(), mesh.geometry.area),
            .confidence = std::move(confidence),
            .part_area = std::move(part_area)};
}

std::vector<MeshLabels> label_faces(const Comm& comm, const Collection& collection, const CutResult& cut,
                                    FaceLabelling labelling, StageLog& log,
                                    const std::vector<std::vector<int>>& given) {
    log.begin("label");
    std::vector<MeshLabels> labels;
    agree(comm, [&] {
        for (std::size_t k = 0; k < collection.local.size(); ++k) {
            labels.push_back(labels_of_mesh(collection.local[k], collection.numbering, cut, labelling.parts,
                                            labelling.refine, given.empty() ? std::vector<int>() : given[k]));
        }
        log.end_of_own_work();
    });
    log.end("one part per face");
    return labels;
}

}  // namespace coseg
