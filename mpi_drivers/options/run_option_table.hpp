#pragma once
// The one table of the options of `coseg run`: key, type, default, range and help; it gives --help, the validation, the
// configuration file and the resolved options of the report.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

enum class OptionSet {
    run,       ///< all
    describe,  ///< those of `coseg describe`: --state is required, what concerns results is left out
};

/// Adds every option of the set to `app` and remembers how to print its resolved value. `options` must outlive both.
class RunOptionTable {
  public:
    RunOptionTable(CLI::App& app, RunOptions& options, OptionSet set = OptionSet::run);

    /// (key, value) of every option after parsing, in the order of --help.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> resolved() const;

  private:
    void add_input_and_output(CLI::App& app, OptionSet set);
    void add_results(CLI::App& app);
    void add_state(CLI::App& app, OptionSet set);
    void add_picture(CLI::App& app);
    void add_patches_and_features(CLI::App& app, OptionSet set);
    void add_feature_weights(CLI::App& app);
    void add_face_features(CLI::App& app, OptionSet set);
    void add_optimisation(CLI::App& app);
    void add_partition(CLI::App& app);
    template <class T>
    CLI::Option* add(CLI::App& app, const std::string& key, T& variable, const std::string& help,
                     const std::string& group);
    CLI::Option* add_switch(CLI::App& app, const std::string& key, bool& variable, const std::string& help,
                            const std::string& group);

    RunOptions& options_;
    std::vector<std::pair<std::string, std::function<std::string()>>> printers_;
    int ranks_ = 0;  // acted on before MPI starts, see self_launch.hpp; here for its check and its help
};

}  // namespace coseg
