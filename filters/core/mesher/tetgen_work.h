#ifndef bindpose_mesher_tetgen_work_h
#define bindpose_mesher_tetgen_work_h

namespace bindpose
{

/// Limit the number of evaluations of TetGen's predicates orient3d() and insphere(). As soon as the
/// number exceeds `limit`, report `work_limit_reached` = 1 and `work`, then end the process by
/// helper_fail(). The limit is needed because TetGen never ends on some inputs. With a time limit
/// instead, the result would depend on the speed of the machine. If TetGen is a static library,
/// evaluations cannot be counted: the reported `work` is 0, and the limit has no effect.
void limit_tetgen_work(double limit);

/// Report the number of evaluations so far as `work`.
void report_tetgen_work();

} // namespace bindpose

#endif
