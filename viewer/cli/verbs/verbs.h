#ifndef bindpose_cli_verbs_verbs_h
#define bindpose_cli_verbs_verbs_h

namespace bindpose::cli
{

class Session;

// Functions that run the verbs (subcommands) of the program, one function per verb. Results and
// errors are stored in the session.
void run_info(Session& session);
void run_winding(Session& session);
void run_tetrahedralize(Session& session);
void run_outline(Session& session);
void run_handles(Session& session);
void run_weights(Session& session);
void run_smooth(Session& session);
void run_deform(Session& session);
void run_rig(Session& session);
void run_transfer(Session& session);
void run_render(Session& session);
void run_view(Session& session);

} // namespace bindpose::cli

#endif
