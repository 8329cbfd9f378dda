// Run TetGen alone, for measure_tets.py. `plain_tetgen SURFACE.off SWITCHES` prints the seconds of
// the call, the number of tets and their volume. The script builds this program; CMake does not.
#include <tetgen.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: plain_tetgen SURFACE.off SWITCHES\n");
    return 1;
  }
  tetgenio in, out;
  if (!in.load_off(argv[1]))
  {
    return 2;
  }
  tetgenbehavior behavior;
  behavior.parse_commandline(argv[2]);
  const auto start = std::chrono::steady_clock::now();
  try
  {
    tetrahedralize(&behavior, &in, &out);
  }
  catch (int)
  {
    return 3;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  double volume = 0.0;
  for (int t = 0; t < out.numberoftetrahedra; ++t)
  {
    const REAL* p[4];
    for (int k = 0; k < 4; ++k)
    {
      p[k] = out.pointlist + 3 * out.tetrahedronlist[t * out.numberofcorners + k];
    }
    double e[3][3];
    for (int k = 0; k < 3; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        e[k][c] = p[k + 1][c] - p[0][c];
      }
    }
    volume += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
      6.0;
  }
  std::printf(
    "seconds %.6f tets %d volume %.17g\n", elapsed.count(), out.numberoftetrahedra, volume);
  std::fflush(stdout);
  std::_Exit(0); // avoid TetGen's destructors, which are not reliable
}
