#include "mpi_drivers/options/option_value.hpp"

namespace coseg {

std::string option_text(const std::vector<OptionValue>& values, Affects last) {
    std::string text;
    for (const OptionValue& option : values) {
        if (option.affects != Affects::nothing && option.affects <= last)
            text += option.key + "=" + option.value + "\n";
    }
    return text;
}

}  // namespace coseg
