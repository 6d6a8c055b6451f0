#include <gtest/gtest.h>

#include "solvers/petsc/petsc_session.hpp"

namespace coseg {
namespace {

TEST(PetscOptions, AcceptsOptionsOfTheSolversInUse) {
    EXPECT_EQ(unknown_petsc_option({}), "");
    EXPECT_EQ(unknown_petsc_option({"-eps_ncv", "80", "-eps_view", "-log_view", "-st_shift", "-1.5"}), "");
}

TEST(PetscOptions, NamesTheFirstThatIsNone) {
    EXPECT_EQ(unknown_petsc_option({"-eps_ncv", "80", "-epsilon", "1"}), "-epsilon");
    EXPECT_EQ(unknown_petsc_option({"mesh.off"}), "mesh.off");
    EXPECT_EQ(unknown_petsc_option({"-eps_ncv", "80", "81"}), "81");
    EXPECT_EQ(unknown_petsc_option({"--parts", "3"}), "--parts");
}

}  // namespace
}  // namespace coseg
