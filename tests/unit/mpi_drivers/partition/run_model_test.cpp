#include "mpi_drivers/partition/run_model.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "io/data_files/result_files.hpp"
#include "io/files/hdf5_file.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

/// The sentence with which a model is refused whose file begins with these options.
std::string refused_options(std::int64_t parts, const std::string& weld) {
    const test::TemporaryFolder folder;
    Hdf5Writer file(folder.path(result_files::model), model_format, model_version);
    file.attribute("parts", parts);
    file.attribute("seed", std::int64_t{-1});  // 2^64 - 1, the largest seed
    file.attribute("weld", weld);
    file.commit();
    return test::error_of([&] { read_run_model(folder.path()); }).sentence;
}

TEST(RunModel, OptionsThatNoRunHasAreRefused) {
    const std::int64_t beyond = (std::int64_t{1} << 32) + 4;
    for (const auto& [sentence, part] :
         {std::pair(refused_options(beyond, "auto"), "model.h5: 'parts' holds 4294967300, "),
          std::pair(refused_options(4, "loosely"), "model.h5: 'weld' has an unknown value; "),
          std::pair(refused_options(4, "auto"), "model.h5: has no attribute 'remesh'")})
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

}  // namespace
}  // namespace coseg
