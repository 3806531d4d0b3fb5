// Which instruction set the roll-up's loop uses: one binary runs everywhere.
#pragma once

#include <string>
#include <vector>

#include "kernel.hpp"

namespace flaprig {

// float or double; the widest vectors that the processor has, unless another was asked for
template <class T>
Kernel<T> chosen_kernel();

// what this processor can do, widest first
std::vector<std::string> kernel_names();
// from now on, for every thread; false where the processor has no such
bool use_kernel(const std::string& name);

// floating-point operations a second of one thread that does nothing but fused multiply-adds on the
// kernel's vectors, two each: what the roll-up's speed is measured against
double fma_peak(bool single);

}  // namespace flaprig
