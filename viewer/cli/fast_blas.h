#ifndef bindpose_cli_fast_blas_h
#define bindpose_cli_fast_blas_h

namespace bindpose::cli
{

/// Start the program again with faster kernels of OpenBLAS if OpenBLAS does not know the processor.
///
/// OpenBLAS chooses its kernels when it is loaded. If the processor is newer than OpenBLAS, it
/// chooses those of the Prescott (2004), which multiply matrices several times slower. The
/// environment variable OPENBLAS_CORETYPE can prevent this, but only before OpenBLAS is loaded. So
/// this function sets the variable and replaces the process by a new one with the same arguments.
/// It does nothing if the variable is set, if the processor has no AVX2, or for another BLAS.
void restart_with_fast_blas(char** arguments);

} // namespace bindpose::cli

#endif
