#pragma once
/// What the kernels of `tiny.cu` and their test exchange.

namespace tiny {

struct Weights {
    double of_a, of_b;
    int times; ///< again, with the two exchanged
};

struct Input {
    const double* values;
    double divisor;
};

struct Output {
    double sum, quotient, root, fused, from_other, weighed, small, large, power;
    long long whole, divided;
    int from_above, any, bits;
    unsigned votes;
};

} // namespace tiny
