// SPDX-License-Identifier: BSD-2-Clause
// Mathematical functions in single precision for a build with EXPHOTON_STOCHASTIC. The linker puts
// them in the place of the library's (--wrap), which do not round at random. Each computes in
// double precision; the conversion of its result then rounds up or down. Without a key they are
// those of the library.
#include <cmath>

#include <cstdint>

extern "C" std::uint32_t exphoton_to_nearest, exphoton_directions[2];

namespace {
bool IsToNearest() { return exphoton_directions[0] == exphoton_to_nearest; }
}  // namespace

#define EXPHOTON_ONE(name)                                                    \
  extern "C" float __real_##name##f(float x);                                 \
  extern "C" float __wrap_##name##f(float x) {                                \
    return IsToNearest() ? __real_##name##f(x) : float(std::name(double(x))); \
  }
#define EXPHOTON_TWO(name)                                                                  \
  extern "C" float __real_##name##f(float x, float y);                                      \
  extern "C" float __wrap_##name##f(float x, float y) {                                     \
    return IsToNearest() ? __real_##name##f(x, y) : float(std::name(double(x), double(y))); \
  }

EXPHOTON_ONE(sin)
EXPHOTON_ONE(cos)
EXPHOTON_ONE(tan)
EXPHOTON_ONE(asin)
EXPHOTON_ONE(acos)
EXPHOTON_ONE(atan)
EXPHOTON_ONE(sinh)
EXPHOTON_ONE(cosh)
EXPHOTON_ONE(tanh)
EXPHOTON_ONE(atanh)
EXPHOTON_ONE(exp)
EXPHOTON_ONE(exp2)
EXPHOTON_ONE(expm1)
EXPHOTON_ONE(log)
EXPHOTON_ONE(log2)
EXPHOTON_ONE(log10)
EXPHOTON_ONE(log1p)
EXPHOTON_ONE(cbrt)
EXPHOTON_ONE(erf)
EXPHOTON_TWO(atan2)
EXPHOTON_TWO(pow)
EXPHOTON_TWO(hypot)

extern "C" void __wrap_sincosf(float x, float* s, float* c) {
  *s = __wrap_sinf(x);
  *c = __wrap_cosf(x);
}
