#pragma once
// Labels by example: reads the labels that a user gives for some of the shapes (--examples).

#include <string>
#include <vector>

#include "io/data_files/name_file.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// The options with a number of parts: without --parts it is that of the labels in the examples, the largest
/// of them plus 1. Rank 0 reads them. Collective. Throws AgreedError: usage without --parts and --examples;
/// input for a folder that cannot be read or has no NAME.seg, a file that is no label file, a label below -1,
/// a label that is not below --parts, and a name of such a label in its names.txt.
RunOptions with_parts_of_examples(const Comm& comm, const RunOptions& options);

/// Of one mesh, parts x its patches, its over-segmentations in order: the area of each patch on faces of each
/// label. label_of_input_face: -1 where nothing is known; empty: nowhere.
Eigen::MatrixXd label_areas(const MeshDescription& mesh, const std::vector<int>& label_of_input_face,
                            int parts);

/// What the examples say of a collection.
struct GivenLabels {
    ExampleLabels patches;  ///< on all ranks; empty without examples
    /// Of each mesh of collection.local: the label of each face of its file, -1 where nothing is said; empty
    /// for a mesh that is no example.
    std::vector<std::vector<int>> faces;
    LabelNames names;  ///< of names.txt beside the labels; on rank 0
};

/// Each rank reads the labels of its meshes, FOLDER/NAME.seg, where options.examples is FOLDER; "" for none.
/// The log has the stage "examples". Collective. Throws AgreedError(input) where a file has not one label for
/// each face, is named like no shape of the collection, or has a label that is not below options.parts.
GivenLabels read_given_labels(const Comm& comm, const Collection& collection, const PartitionOptions& options,
                              StageLog& log);

/// The same of a collection that is to be segmented, with a warning for each label below options.parts that
/// no example shows.
GivenLabels read_examples(const Comm& comm, const Collection& collection, const PartitionOptions& options,
                          StageLog& log);

/// FOLDER/names.txt, where `coseg export` and `coseg render` look for the names of parts; nothing where no
/// part has a name. `names`: on rank 0. Collective; throws AgreedError(output).
void write_part_names(const Comm& comm, const std::string& folder, const LabelNames& names);

}  // namespace coseg
