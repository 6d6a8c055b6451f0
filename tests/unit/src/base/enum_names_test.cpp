#include "src/base/enum_names.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

enum class Fruit { apple, pear };
constexpr std::array<EnumName<Fruit>, 2> enum_names(Fruit /*type*/) {
    return {{{Fruit::pear, "pear"}, {Fruit::apple, "apple"}}};
}
constexpr std::array<EnumName<Fruit>, 1> enum_aliases(Fruit /*type*/) { return {{{Fruit::apple, "pomme"}}}; }

enum class Unnamed { one };
static_assert(NamedEnum<Fruit>);
static_assert(!NamedEnum<Unnamed>);
static_assert(!NamedEnum<int>);

TEST(EnumNames, EveryNameLeadsBackToItsEnumerator) {
    for (const std::string& name : names_of<Fruit>()) EXPECT_EQ(to_string(named<Fruit>(name).value()), name);
    EXPECT_EQ(names_of<Fruit>(), (std::vector<std::string>{"pear", "apple"}));
}

TEST(EnumNames, AnAliasIsUnderstoodButNotWritten) {
    EXPECT_EQ(named<Fruit>("pomme"), Fruit::apple);
    EXPECT_EQ(to_string(named<Fruit>("pomme").value()), "apple");
}

TEST(EnumNames, OtherWordsAreNoNames) {
    for (const char* word : {"", "Apple", "app", "apples"}) EXPECT_FALSE(named<Fruit>(word)) << word;
    EXPECT_EQ(name_of(static_cast<Fruit>(7)), "");
}

}  // namespace
}  // namespace coseg
