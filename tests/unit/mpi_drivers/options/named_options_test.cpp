#include "mpi_drivers/options/named_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/errors.hpp"

namespace coseg {
namespace {

TEST(NamedOptions, ValuesAreThoseOfTheCommandLine) {
    const RunOptions options = options_by_name({{"patches", "31"},
                                                {"choose", "false"},
                                                {"seed", "7"},
                                                {"feature-weights", "1,0,2"},
                                                {"scope", "rows"},
                                                {"lambda", "0.25"}});
    EXPECT_EQ(options.description.patches, 31);
    EXPECT_FALSE(options.partition.choose);
    EXPECT_EQ(options.description.seed, 7U);
    EXPECT_EQ(options.partition.seed, 7U);
    EXPECT_EQ(options.features.weights[1], 0.0);
    EXPECT_EQ(options.features.weights[2], 2.0);
    EXPECT_EQ(options.features.weights[3], default_descriptor_weights()[3]);
    EXPECT_EQ(options.optimise.scope, PenaltyScope::rows);
    EXPECT_EQ(options.optimise.lambda, 0.25);
    EXPECT_TRUE(options.output.folder.empty());
    EXPECT_TRUE(options.process.inputs.empty());
}

TEST(NamedOptions, APresetGivesWayToWhatIsGiven) {
    const RunOptions options = options_by_name({{"alpha", "3"}, {"preset", "paper"}});
    EXPECT_EQ(options.preset, "paper");
    EXPECT_EQ(options.description.oversegmentations, 1);
    EXPECT_EQ(options.optimise.alpha, 3.0);
}

TEST(NamedOptions, SmallCollectionsGetMoreOversegmentations) {
    const auto found = [](const std::vector<NamedOption>& given, std::size_t shapes) {
        return with_oversegmentations(options_by_name(given).description, shapes).oversegmentations;
    };
    const std::vector<std::pair<std::size_t, int>> expected = {{1, 12}, {4, 12}, {5, 10},  {6, 8},  {7, 7},
                                                               {8, 6},  {9, 6},  {12, 4},  {15, 4}, {16, 3},
                                                               {20, 3}, {17, 3}, {2000, 3}};
    for (const auto& [shapes, number] : expected) {
        EXPECT_EQ(found({}, shapes), number) << shapes;
        EXPECT_EQ(found({{"oversegmentations", "auto"}}, shapes), number) << shapes;
        EXPECT_EQ(found({{"oversegmentations", "5"}}, shapes), 5) << shapes;
        EXPECT_EQ(found({{"preset", "paper"}}, shapes), 1) << shapes;
    }
}

TEST(NamedOptions, WithoutAnyTheyAreTheDefaults) {
    const std::vector<OptionValue> given = option_values(options_by_name({}));
    const std::vector<OptionValue> standard = option_values({});
    ASSERT_EQ(given.size(), standard.size());
    for (std::size_t k = 0; k < given.size(); ++k) {
        if (given[k].key == "parts") continue;
        EXPECT_EQ(given[k].value, standard[k].value) << given[k].key;
    }
}

TEST(NamedOptions, WhatIsWrongIsRefused) {
    const auto sentence = [](const NamedOption& option) {
        const test::Caught caught = test::error_of([&] { options_by_name({option}); });
        EXPECT_EQ(caught.code, ExitCode::usage) << option.first;
        return caught.sentence;
    };
    EXPECT_NE(sentence({"patchs", "3"}).find("did you mean 'patches'"), std::string::npos);
    EXPECT_NE(sentence({"patches", "1"}).find("--patches"), std::string::npos);
    EXPECT_NE(sentence({"patches", "many"}).find("--patches"), std::string::npos);
    EXPECT_NE(sentence({"oversegmentations", "0"}).find("neither auto nor a number from 1 to 20"),
              std::string::npos);
    EXPECT_NE(sentence({"alpha", "nan"}).find("finite"), std::string::npos);
    EXPECT_NE(sentence({"scope", "columns"}).find("columns"), std::string::npos);
    EXPECT_NE(sentence({"out", "here"}).find("'out' is no option"), std::string::npos);
    EXPECT_NE(sentence({"--patches", "3"}).find("is no option"), std::string::npos);
}

TEST(NamedOptions, NamesLeaveOutTheCommandLineOnes) {
    const std::vector<std::string> names = named_option_names();
    const auto has = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    EXPECT_TRUE(has("geodesic-samples"));
    EXPECT_TRUE(has("preset"));
    for (const char* name : {"out", "state", "quiet", "config", "parts"}) EXPECT_FALSE(has(name)) << name;
}

}  // namespace
}  // namespace coseg
