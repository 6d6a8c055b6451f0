#include "tests/support/tests_of_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

namespace {

/// GoogleTest's filter of all tests whose source ends with `name`; empty if there are none.
std::string filter_of(const std::string& name) {
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    std::string filter;
    for (int s = 0; s < all.total_test_suite_count(); ++s) {
        const testing::TestSuite& suite = *all.GetTestSuite(s);
        for (int t = 0; t < suite.total_test_count(); ++t) {
            const testing::TestInfo& test = *suite.GetTestInfo(t);
            if (!std::string_view(test.file()).ends_with("/" + name)) continue;
            filter += (filter.empty() ? "" : ":") + (std::string(suite.name()) + "." + test.name());
        }
    }
    return filter;
}

}  // namespace

bool choose_tests_of_file(int& argc, char** argv) {
    for (int i = 1; i + 1 < argc; ++i) {
        if (std::string_view(argv[i]) != "--tests-of") continue;
        const std::string chosen = filter_of(argv[i + 1]);
        if (chosen.empty()) {
            std::fprintf(stderr, "error: no test stands in a source %s\n", argv[i + 1]);
            return false;
        }
        GTEST_FLAG_SET(filter, chosen);
        std::copy(argv + i + 2, argv + argc + 1, argv + i);
        argc -= 2;
        return true;
    }
    return true;
}
