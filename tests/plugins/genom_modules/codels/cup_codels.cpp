#include <accup.h>
#include <cup_cxx_types.h>

genom::event cup_pour(const ::cup_drink& drink, std::vector< ::cup_drink>& drinks, std::string& last) {
  drinks.push_back(drink);
  last = drink.name;
  return genom::ok;
}
