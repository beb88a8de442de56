#pragma once
// Empty: Eigen includes the header of MMX before that of SSE2, and uses nothing of it.
