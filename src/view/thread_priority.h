// The priority of threads that render beside a browser.
#pragma once

namespace nephroid {

/// Lets others go first: this thread and the threads that it starts from now on. Browsers compose
/// pages on the same cores and, without a graphics card, draw WebGL there, too. Nothing is lost
/// while they have nothing to do.
void give_way_to_others();

}  // namespace nephroid
