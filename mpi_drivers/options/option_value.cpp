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

std::vector<OptionValue> with_part_number(std::vector<OptionValue> values, int parts) {
    for (OptionValue& option : values) {
        if (option.key == "parts") option.value = std::to_string(parts);
    }
    return values;
}

}  // namespace coseg
