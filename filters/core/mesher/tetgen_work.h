#ifndef bindpose_mesher_tetgen_work_h
#define bindpose_mesher_tetgen_work_h

namespace bindpose
{

/// End the process by helper_fail() as soon as TetGen has evaluated its predicates orient3d() and
/// insphere() more than `limit` times; report `work_limit_reached` = 1 and `work` before. On some
/// inputs TetGen never ends. A limit of time would make the result depend on the speed of the
/// machine; a limit of work does not. If TetGen is a static library, its work cannot be counted: it
/// is 0, and the limit has no effect.
void limit_tetgen_work(double limit);

/// Report the number of evaluations so far as `work`.
void report_tetgen_work();

} // namespace bindpose

#endif
