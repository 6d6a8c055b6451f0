#pragma once
// The stage of a run that follows corrections and constraints (--corrections, --constraints).

#include <string>
#include <vector>

#include "io/data_files/correction_file.hpp"
#include "mpi_drivers/editing/corrected_cut.hpp"
#include "mpi_drivers/options/option_value.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// In the options of the report of a corrected run: the number of parts before the corrections.
inline constexpr const char* base_parts_key = "base-parts";

/// What the files of a command line say, the same on all ranks.
struct GivenCorrections {
    std::string path;              ///< of the corrections; "" where there are none
    std::string run;               ///< the hash that they carry
    std::vector<Correction> acts;  ///< corrections, then constraints
    bool is_given = false;         ///< whether there is a file of either
};

/// Reads both files on rank 0. Collective; throws AgreedError(input) as read_corrections does.
GivenCorrections read_given_corrections(const Comm& comm, const PartitionOptions& options);

/// The options, with levels where an act needs the tree of these.
RunOptions with_levels_for(const GivenCorrections& given, RunOptions options);

/// The options for the report: `parts` as they are now, and base_parts_key as they were asked for.
std::vector<OptionValue> with_corrected_parts(std::vector<OptionValue> values, int parts);

/// Throws AgreedError(input) where corrections are of another run than that of the base. Collective.
void refuse_other_run(const Comm& comm, const CorrectionBase& base, const std::string& hash,
                      const std::string& path);

/// What came of it.
struct FollowedCorrections {
    CorrectedCut corrected;
    int parts = 0;
    CorrectionFile file;               ///< for the folder of results
    std::map<int, std::string> names;  ///< of the parts that have one, on rank 0
};

/// The log has the stage "corrections". Collective; throws AgreedError(input) as refuse_other_run,
/// state_after and corrected_cut do.
FollowedCorrections follow_corrections(const Comm& comm, const CorrectionBase& base,
                                       const GivenCorrections& given, const SolvedPatches& patches,
                                       const PartitionOptions& options, StageLog& log);

}  // namespace coseg
