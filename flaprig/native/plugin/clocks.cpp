// The plugin's clocks, for whoever loads the library: its copy of the solver is not the module's.
#include "../clock.hpp"

extern "C" {

__attribute__((visibility("default"))) void flaprig_reset_clocks() { flaprig::reset_clocks(); }

// seconds of one of the clocks; negative where there is no such
__attribute__((visibility("default"))) double flaprig_clock(const char* name) {
  const auto all = flaprig::clocks();
  const auto found = all.find(name);
  return found == all.end() ? -1 : found->second;
}

}
