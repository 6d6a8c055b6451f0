#include "mpi_drivers/options/run_option_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mpi_drivers/describe/description_file.hpp"
#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/partition/partition_checkpoint.hpp"
#include "src/base/index.hpp"

namespace coseg {
namespace {

/// What a command line of `coseg run` comes to; throws what the parser throws.
RunOptions parsed(std::vector<std::string> words) {
    CLI::App app;
    RunOptions options;
    const RunOptionTable table(app, options);
    if (std::find(words.begin(), words.end(), "--parts=4") == words.end()) words.emplace_back("--parts=3");
    if (std::find(words.begin(), words.end(), "--out=elsewhere") == words.end())
        words.emplace_back("--out=here");
    words.emplace_back("meshes");
    std::reverse(words.begin(), words.end());
    app.parse(words);
    return options;
}

std::map<std::string, OptionValue> by_key(const RunOptions& options) {
    std::map<std::string, OptionValue> values;
    for (const OptionValue& option : option_values(options)) values[option.key] = option;
    return values;
}

TEST(RunOptionTable, TakesANumberOfPartsOrFindsIt) {
    CLI::App app;
    RunOptions options;
    const RunOptionTable table(app, options);
    const auto parse = [&](const std::string& parts) {
        app.parse(std::vector<std::string>{"m", "--out=x", parts});
    };
    parse("--parts=auto");
    EXPECT_EQ(options.partition.parts, found_parts);
    EXPECT_EQ(by_key(options)["parts"].value, "auto");
    parse("--parts=12");
    EXPECT_EQ(options.partition.parts, 12);
    EXPECT_EQ(by_key(options)["parts"].value, "12");
    for (const char* bad : {"--parts=0", "--parts=1001", "--parts=-1", "--parts=3.5", "--parts=Auto"})
        EXPECT_THROW(parse(bad), CLI::ParseError) << bad;
}

TEST(RunOptionTable, SaysWhatEachNamedOptionTakes) {
    const std::vector<std::string> names = named_option_names();
    const std::vector<OptionKind> kinds = named_option_kinds();
    ASSERT_EQ(names.size(), kinds.size());
    std::map<std::string, OptionKind> kind_of;
    for (std::size_t k = 0; k < names.size(); ++k) kind_of[names[k]] = kinds[k];
    for (const char* name : {"patches", "seed", "max-iterations", "subsets"})
        EXPECT_EQ(kind_of.at(name), OptionKind::whole_number) << name;
    for (const char* name : {"alpha", "gap", "cut-noise"})
        EXPECT_EQ(kind_of.at(name), OptionKind::number) << name;
    for (const char* name : {"choose", "sheet", "levels"})
        EXPECT_EQ(kind_of.at(name), OptionKind::on_or_off) << name;
    for (const char* name : {"links", "weld", "remesh", "preset", "view", "examples", "oversegmentations"})
        EXPECT_EQ(kind_of.at(name), OptionKind::text) << name;
    EXPECT_EQ(kind_of.at("feature-weights"), OptionKind::numbers);
    EXPECT_EQ(kind_of.count("parts"), 0U);  // said in another way
}

/// Another value of every option of the table but --config and --preset, as it stands on the command line.
const std::map<std::string, std::vector<std::string>> changes = {
    {"parts", {"--parts=4"}},
    {"examples", {"--examples=folder"}},
    {"corrections", {"--corrections=file"}},
    {"constraints", {"--constraints=file"}},
    {"out", {"--out=elsewhere"}},
    {"keep-model", {"--no-keep-model"}},
    {"force", {"--force"}},
    {"profile", {"--profile"}},
    {"strict", {"--strict"}},
    {"keep-features", {"--keep-features"}},
    {"quiet", {"--quiet"}},
    {"verbose", {"--verbose"}},
    {"json-log", {"--json-log"}},
    {"seed", {"--seed=2"}},
    {"state", {"--state=folder"}},
    {"checkpoint-seconds", {"--checkpoint-seconds=5"}},
    {"sheet", {"--no-sheet"}},
    {"html", {"--no-html"}},
    {"view", {"--view=front"}},
    {"up", {"--up=z"}},
    {"align", {"--align=off"}},
    {"weld", {"--weld=1e-4"}},
    {"remesh", {"--remesh=never"}},
    {"patches", {"--patches=51"}},
    {"oversegmentations", {"--oversegmentations=2"}},
    {"cut-noise", {"--cut-noise=0.2"}},
    {"geodesic-samples", {"--geodesic-samples=301"}},
    {"bins", {"--bins=101"}},
    {"word-sets", {"--word-sets=2"}},
    {"histogram", {"--histogram=counts"}},
    {"ranges", {"--ranges=global"}},
    {"feature-weights", {"--feature-weights=1,1,1,1,1"}},
    {"face-features", {"--face-features=folder"}},
    {"face-feature-weight", {"--face-feature-weight=2"}},
    {"variant", {"--variant=ssc"}},
    {"feature", {"--feature=average_geodesic"}},
    {"scope", {"--scope=rows"}},
    {"links", {"--links=7"}},
    {"alpha", {"--alpha=0.02"}},
    {"beta", {"--beta=0.2"}},
    {"lambda", {"--lambda=3"}},
    {"solver", {"--solver=working-set"}},
    {"gap", {"--gap=1e-3"}},
    {"max-iterations", {"--max-iterations=9"}},
    {"max-seconds", {"--max-seconds=9"}},
    {"affinity", {"--affinity=formula-8"}},
    {"drop-below", {"--drop-below=1e-3"}},
    {"cut-offset", {"--cut-offset=0.5"}},
    {"adjacency", {"--adjacency=4"}},
    {"overlap", {"--overlap=2"}},
    {"mesh-balance", {"--mesh-balance=0.1"}},
    {"choose", {"--no-choose"}},
    {"levels", {"--levels"}},
    {"subsets", {"--subsets=5"}},
    {"segments", {"--segments"}},
    {"partition", {"--partition=diffusion"}},
    {"refine", {"--refine=none"}},
    {"places", {"--no-places"}},
};

std::string cut_text(const RunOptions& options) { return cut_option_text(option_values(options), {}); }

ContentHash description_key_of(const RunOptions& options) {
    return description_key("OFF", "a", "a.off", description_options(options));
}

TEST(RunOptionTable, EveryOptionIsTestedForWhatItAffects) {
    for (const auto& [key, option] : by_key({})) {
        EXPECT_NE(name_of(option.affects), "") << key;
        if (key == "preset" || key == "config") {
            EXPECT_EQ(option.affects, Affects::nothing) << key;
            continue;
        }
        ASSERT_TRUE(changes.contains(key)) << key << " is new: add it to the list of changes";
        const OptionValue changed = by_key(parsed(changes.at(key))).at(key);
        EXPECT_NE(changed.value, by_key(parsed({})).at(key).value) << key;
    }
}

TEST(RunOptionTable, ACutIsFoundAgainUnlessAnOptionOfItsStagesChanges) {
    const std::string text = cut_text(parsed({}));
    for (const auto& [key, option] : by_key({})) {
        if (!changes.contains(key)) continue;
        const bool counts = option.affects != Affects::nothing && option.affects != Affects::output;
        EXPECT_EQ(cut_text(parsed(changes.at(key))) != text, counts) << key;
    }
    // What a preset stands for counts, its name does not.
    EXPECT_NE(cut_text(parsed({"--preset=paper"})), text);
    EXPECT_EQ(cut_text(parsed({"--preset=default"})), text);
}

TEST(RunOptionTable, ADescriptionIsFoundAgainUnlessAnOptionOfItChanges) {
    const ContentHash hash = description_key_of(parsed({}));
    for (const auto& [key, option] : by_key({})) {
        if (!changes.contains(key)) continue;
        EXPECT_EQ(description_key_of(parsed(changes.at(key))) != hash, option.affects == Affects::describe)
            << key;
    }
}

/// The key of the optimiser's tiles for three small meshes.
ContentHash tile_key(const OptimiseOptions& options) {
    Collection collection;
    collection.meshes.resize(3);
    for (int m = 0; m < 3; ++m) collection.meshes[at(m)].name = std::to_string(m);
    collection.numbering = PatchNumbering(1, {2, 2, 2});
    SubspaceProblem problem = subspace_problem(collection, options);
    problem.features = std::vector<Eigen::MatrixXd>{Eigen::MatrixXd::Identity(6, 6)};
    return problem_key(problem, solve_options(options));
}

TEST(RunOptionTable, TilesAreFoundAgainUnlessAnOptionOfTheSolveChanges) {
    const ContentHash key = tile_key(parsed({}).optimise);
    for (const auto& [name, option] : by_key({})) {
        if (!changes.contains(name) || option.affects == Affects::solve) continue;
        EXPECT_EQ(tile_key(parsed(changes.at(name)).optimise), key) << name;
    }
    for (const char* name : {"scope", "alpha", "beta", "lambda", "solver", "gap", "max-iterations"})
        EXPECT_NE(tile_key(parsed(changes.at(name)).optimise), key) << name;
}

TEST(RunOptionTable, ThePapersPresetIsASetOfValues) {
    const RunOptions paper = parsed({"--preset", "paper"});
    EXPECT_EQ(paper.optimise.scope, PenaltyScope::rows);
    EXPECT_EQ(paper.partition.affinity, AffinityForm::formula_8);
    EXPECT_EQ(paper.partition.drop_below, 1e-6);
    EXPECT_EQ(paper.partition.cut_offset, 0.5);
    EXPECT_EQ(paper.partition.mesh_balance, 0.0);
    EXPECT_EQ(paper.output.refine, RefineMode::fuzzy);
    EXPECT_EQ(parsed({"--alpha", "0.5", "--preset", "paper"}).optimise.alpha, 0.5);
    for (const std::string& name : preset_names()) EXPECT_EQ(preset_options(name).preset, name);
}

TEST(RunOptionTable, OldWordsAreUnderstoodAndNewOnesReported) {
    EXPECT_EQ(parsed({"--scope", "paper"}).optimise.scope, PenaltyScope::rows);
    EXPECT_EQ(parsed({"--scope", "mesh"}).optimise.scope, PenaltyScope::meshes);
    EXPECT_EQ(by_key(parsed({"--scope", "paper"})).at("scope").value, "rows");
}

TEST(RunOptionTable, TheSeedIsThatOfEveryStage) {
    const RunOptions options = parsed({"--seed", "9"});
    for (const std::uint64_t seed :
         {options.description.seed, options.features.seed, options.optimise.seed, options.partition.seed})
        EXPECT_EQ(seed, 9U);
}

TEST(RunOptionTable, WeldingIsAWordOrATolerance) {
    EXPECT_EQ(to_string(parsed({"--weld", "exact"}).description.weld), "exact");
    EXPECT_EQ(parsed({"--weld", "2e-4"}).description.weld.tolerance, 2e-4);
    EXPECT_EQ(to_string(parsed({"--weld", "2e-4"}).description.weld), "2e-04");
    EXPECT_EQ(border_limits(parsed({}).description.weld).of_size, BorderLimits{}.of_size);
    for (const char* text : {"0", "-1e-4", "0.02", "1e-4x", "", "always", "nan", "inf"})
        EXPECT_FALSE(parsed_weld(text)) << text;
    EXPECT_THROW(parsed({"--weld", "0.5"}), CLI::ValidationError);
}

TEST(RunOptionTable, LinksAreAWordOrANumber) {
    EXPECT_EQ(to_string(parsed({"--links", "all"}).optimise.links), "all");
    EXPECT_EQ(parsed({"--links", "12"}).optimise.links.meshes, 12);
    for (const char* text : {"1", "0", "-3", "2x", "", "some", "99999999999"})
        EXPECT_FALSE(parsed_links(text)) << text;
    EXPECT_THROW(parsed({"--links", "1"}), CLI::ValidationError);
    EXPECT_THROW(parsed({"--scope", "columns"}), CLI::ValidationError);
}

}  // namespace
}  // namespace coseg
