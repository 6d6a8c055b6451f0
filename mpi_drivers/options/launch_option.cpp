#include "mpi_drivers/options/launch_option.hpp"

#include "mpi_drivers/options/option_checks.hpp"

namespace coseg {

namespace {

constexpr const char* option_name = "--ranks";

}  // namespace

CLI::Option* add_ranks_option(CLI::App& command) {
    return command
        .add_option(option_name, "Ranks of a command that is started without mpirun; 0: one for each core")
        ->type_name("INT")
        ->check(CLI::Range(0, most_ranks_of_a_launch))
        ->transform(decimal_digits);
}

std::optional<LaunchRequest> launch_request(const CLI::App& command) {
    const CLI::Option* ranks = command.get_option_no_throw(option_name);
    if (ranks == nullptr) return std::nullopt;
    const CLI::Option* state = command.get_option_no_throw("--state");
    LaunchRequest request;
    if (ranks->count() > 0) request.ranks = ranks->as<int>();
    request.keeps_state = state != nullptr && state->count() > 0;
    return request;
}

}  // namespace coseg
