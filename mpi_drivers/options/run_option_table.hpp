#pragma once
// The one table of the options of `coseg run`: key, type, default, range, help and what it affects; it gives
// --help, the validation, the configuration file, the resolved options of the report and the keys of a state
// folder.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "mpi_drivers/options/option_value.hpp"
#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

enum class OptionSet {
    run,       ///< all options
    describe,  ///< the options of `coseg describe`: --state is required, and those of results are left out
};

/// Adds every option of the set to `app` and remembers how to print its resolved value. `options` must
/// outlive both.
class RunOptionTable {
  public:
    RunOptionTable(CLI::App& app, RunOptions& options, OptionSet set = OptionSet::run);

    /// Every option after parsing, in the order of --help.
    [[nodiscard]] std::vector<OptionValue> values() const;

  private:
    struct Row {
        std::string key;
        Affects affects;
        const char* group;
        std::string help;
    };
    void add_input_and_output(OptionSet set);
    void add_preset();
    void add_seed();
    void add_results();
    void add_state(OptionSet set);
    void add_picture();
    void add_patches();
    void add_features(OptionSet set);
    void add_feature_weights();
    void add_face_features(OptionSet set);
    void add_problem();
    void add_solver();
    void add_partition();
    void add_choice();
    template <class T>
    CLI::Option* add(const Row& row, T& variable);
    CLI::Option* add_switch(const Row& row, bool& variable);
    /// 1 to `most`, or the word auto, which is `found` in the variable.
    CLI::Option* add_number_or_auto(const Row& row, int& variable, int found, int most);
    void remember(const Row& row, OptionKind kind, std::function<std::string()> print);

    struct Printer {
        std::string key;
        Affects affects;
        OptionKind kind;
        std::function<std::string()> print;
    };
    CLI::App& app_;
    RunOptions& options_;
    std::vector<Printer> printers_;
};

}  // namespace coseg
