// Threads that wait for work between calls: starting one takes longer than a small roll-up.
#pragma once

#include <functional>

namespace flaprig {

// calls work(i) for i = 0 to count - 1 on up to `threads` threads, the caller one of them; each takes
// the next number that is free. Where the pool is busy with another call, the caller does all alone.
// What work throws ends the call and is thrown here.
void in_parallel(int threads, int count, const std::function<void(int)>& work);

}  // namespace flaprig
