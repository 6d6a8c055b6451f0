#pragma once
// Scores labels against several people's segmentations of each mesh, in the folder layout of the Princeton
// benchmark.

#include <string>
#include <vector>

#include "io/mesh_files/mesh_list.hpp"
#include "src/metrics/segmentation_agreement.hpp"

namespace coseg {

struct AnnotatedShape {
    std::string name;
    bool missing = false;                           ///< no label file
    std::vector<SegmentationAgreement> annotators;  ///< one for each annotator, by file name
};

/// Compares labels_folder/NAME.seg of every mesh with annotators_folder/NAME/NAME_*.seg. Parts are first
/// split into their connected pieces, because the benchmark's segments are pieces. Meshes without annotators
/// are left out. Throws Error(input) for files that do not fit, or if no mesh has an annotator.
std::vector<AnnotatedShape> compare_with_annotators(const std::vector<MeshEntry>& meshes,
                                                    const std::string& annotators_folder,
                                                    const std::string& labels_folder);

/// One JSON object with means over annotators and then over shapes, and the same for each shape.
/// cut_discrepancy is null where no pair has one.
std::string annotator_json(const std::vector<AnnotatedShape>& shapes);

}  // namespace coseg
