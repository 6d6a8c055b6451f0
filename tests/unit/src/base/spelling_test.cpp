#include "src/base/spelling.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(Spelling, CountsTheLettersToChange) {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Spelling, FindsWhatWasMeantOrNothing) {
    const std::vector<std::string> options = {"--parts", "--patches", "--out"};
    EXPECT_EQ(nearest_word("--pars", options), "--parts");
    EXPECT_EQ(nearest_word("--pathces", options), "--patches");
    EXPECT_EQ(nearest_word("--wavelength", options), "");
}

}  // namespace
}  // namespace coseg
