// Runs the unit tests: all of them, those of one source (--tests-of), or what GoogleTest's own options name.

#include <gtest/gtest.h>

#include "tests/support/tests_of_file.hpp"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    return choose_tests_of_file(argc, argv) ? RUN_ALL_TESTS() : 1;
}
