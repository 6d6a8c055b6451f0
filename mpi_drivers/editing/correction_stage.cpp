#include "mpi_drivers/editing/correction_stage.hpp"

#include <algorithm>
#include <memory>

#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

GivenCorrections read_given_corrections(const Comm& comm, const PartitionOptions& options) {
    GivenCorrections given;
    given.path = options.corrections;
    given.is_given = !options.corrections.empty() || !options.constraints.empty();
    agree(comm, [&] {
        if (!comm.is_root()) return;
        if (!options.corrections.empty()) {
            CorrectionFile file = read_corrections(options.corrections);
            given.run = std::move(file.run);
            given.acts = std::move(file.acts);
        }
        if (options.constraints.empty()) return;
        for (Correction& c : read_constraints(options.constraints)) given.acts.push_back(std::move(c));
    });
    broadcast(comm, given.run);
    broadcast(comm, given.acts);
    return given;
}

RunOptions with_levels_for(const GivenCorrections& given, RunOptions options) {
    options.partition.levels = options.partition.levels ||
                               std::any_of(given.acts.begin(), given.acts.end(), [](const Correction& c) {
                                   return c.kind == CorrectionKind::split || c.kind == CorrectionKind::level;
                               });
    return options;
}

std::vector<OptionValue> with_corrected_parts(std::vector<OptionValue> values, int parts) {
    const auto row = std::find_if(values.begin(), values.end(),
                                  [](const OptionValue& value) { return value.key == "parts"; });
    if (row == values.end()) throw Error(ExitCode::internal, "a run has no option of parts");
    OptionValue asked = *row;
    asked.key = base_parts_key;
    row->value = std::to_string(parts);
    values.push_back(asked);
    return values;
}

void refuse_other_run(const Comm& comm, const CorrectionBase& base, const std::string& hash,
                      const std::string& path) {
    agree(comm, [&] {
        if (hash != base_hash(base))
            throw Error(
                ExitCode::input,
                path +
                    ": is about another run: its meshes, their order, or the options or the coseg that "
                    "made the parts differ; run coseg run as that run was");
    });
}

FollowedCorrections follow_corrections(const Comm& comm, const CorrectionBase& base,
                                       const GivenCorrections& given, const SolvedPatches& patches,
                                       const PartitionOptions& options, StageLog& log) {
    log.begin("corrections");
    if (!given.path.empty()) refuse_other_run(comm, base, given.run, given.path);
    const std::unique_ptr<CorrectedParts> parts = corrected_parts_of(comm, base, patches, options);
    const CorrectionState state = state_after(comm, base, given.acts);
    FollowedCorrections followed{corrected_cut(comm, base, state, given.acts, *parts),
                                 state.part_count(),
                                 {base_hash(base), given.acts, {}},
                                 state.names()};
    log.end(with_unit(static_cast<std::int64_t>(given.acts.size()), "act", "acts"));
    return followed;
}

}  // namespace coseg
