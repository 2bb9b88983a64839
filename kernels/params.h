/* params.h - one argument struct, read by the kernels and by their host wrappers.
 *
 * The host sees a template over the scalar type, the device a plain struct in its own precision:
 *     PARAMS_BEGIN(RayParams) real h; int n; int pad_; PARAMS_END(RayParams)
 * Scalars only (a double3 would be 32-byte aligned), reals first, an even number of ints last.
 */
#ifndef KREISEL_PARAMS_H
#define KREISEL_PARAMS_H
/* Terms that a kernel adds up plainly before they enter an accumulator (real.h). */
#define KREISEL_RUN 8
#ifdef __cplusplus
#define PARAMS_BEGIN(Name) template <class real> struct Name {
#define PARAMS_END(Name) };
#else
#include "real.h"
#define PARAMS_BEGIN(Name) typedef struct {
#define PARAMS_END(Name) } Name;
#endif
#endif
