// The options that functions of the interface take by name.

#include <coseg/coseg.hpp>

#include "io/interface/failures.hpp"
#include "mpi_drivers/options/named_options.hpp"

namespace coseg {

std::vector<std::string> interface_1::option_names() { return with_failures(named_option_names); }

std::vector<std::string> interface_1::option_kinds() {
    return with_failures([] {
        std::vector<std::string> words;
        for (const OptionKind kind : named_option_kinds()) words.emplace_back(to_string(kind));
        return words;
    });
}

}  // namespace coseg
