#pragma once
// The pipeline of `coseg run`: from a list of meshes to one consistent segmentation, stage by stage.

#include <string>
#include <vector>

#include "io/data_files/alignment_file.hpp"
#include "mpi_drivers/editing/corrected_cut.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "mpi_drivers/partition/partition_stage.hpp"
#include "mpi_drivers/partition/run_model.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// The outcome of a run. Labels and descriptions of meshes are on the ranks that hold them.
struct CoSegmented {
    RunOptions options;  ///< as given, with the numbers that were found: of parts and of over-segmentations
    Collection collection;
    Optimisation optimisation;
    CutResult cut;
    std::vector<MeshLabels> labels;
    ModelPatches
        model;  ///< of options.output.keep_model; on rank 0, or on all ranks where `entries` are given
    std::string report;       ///< the text of report.json, on rank 0
    AlignmentFile alignment;  ///< in the units of the meshes, on all ranks, where `entries` are given
};

/// A collection and its partition, before anything that a person says of it is followed.
struct BasePartition {
    RunOptions options;  ///< with the number of parts
    Collection collection;
    PatchFeatures features;
    Optimisation optimisation;
    CutResult cut;
    GivenLabels examples;

    /// What corrections are about. It refers to this.
    [[nodiscard]] CorrectionBase base() const {
        return {collection, cut, options.partition.parts, examples.faces, examples.names};
    }
    /// What they are followed with. It refers to this.
    [[nodiscard]] SolvedPatches solved() const { return {features, optimisation.result.coefficients}; }
};

/// Describes, solves and cuts the meshes as co_segment does, and writes no results. Collective. Throws
/// AgreedError.
BasePartition base_partition(const Comm& comm, const std::vector<MeshEntry>& entries, const RunOptions& given,
                             const std::vector<std::string>& petsc_arguments, StageLog& log);

/// Runs all stages on the meshes `entries`, or where this is null on those that given.process.inputs name.
/// The folder of results is written if given.output.folder has a name. petsc_arguments are the words that
/// follow `--` on the command line. The caller has started PETSc. Collective. Throws AgreedError.
CoSegmented co_segment(const Comm& comm, const std::vector<MeshEntry>* entries, const RunOptions& given,
                       const std::vector<std::string>& petsc_arguments, StageLog& log);

/// The command: starts PETSc, runs all stages and writes the folder of results. Collective. Throws
/// AgreedError. not_converged is thrown also after everything is written, where a limit ended the optimiser
/// before its gap.
void co_segment(const Comm& comm, const RunOptions& options,
                const std::vector<std::string>& petsc_arguments = {});

}  // namespace coseg
