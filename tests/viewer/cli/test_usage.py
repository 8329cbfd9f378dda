"""Unknown verbs and options, and the help and version texts of the program."""

import pytest

VERBS = ["info", "winding", "tetrahedralize", "handles", "weights", "deform", "render", "view"]


def test_help_lists_all_verbs(folder):
    run = folder.run("--help").is_good()
    for verb in VERBS:
        assert f"\n  {verb} " in run.out
    assert "option-table" not in run.out and "key-table" not in run.out
    assert folder.run("--version").is_good().out.startswith("bindpose 0.")


@pytest.mark.parametrize("verb", VERBS)
def test_each_verb_has_help(folder, verb):
    run = folder.run(verb, "--help").is_good()
    for option in ("--report FILE", "--threads N", "--quiet", "--overwrite"):
        assert option in run.out


@pytest.mark.parametrize("words, sentence", [
    ([], "no verb is given; expected one of info, winding"),
    (["dance"], "'dance' is not a verb"),
    (["wieghts", "a.off"], "'wieghts' is not a verb; did you mean 'weights'?"),
    (["info"], "FILE is required"),
    (["winding", "a.off"], "--output is required"),
    (["info", "a.off", "--loud"], "unknown option '--loud'"),
    (["deform", "a.off", "--metod", "lbs"], "unknown option '--metod'; did you mean '--method'?"),
    (["deform", "a.off", "--metod=lbs"], "unknown option '--metod'; did you mean '--method'?"),
    (["info", "a.off", "b.off"], "unexpected argument 'b.off'; expected positional arguments: FILE"),
    (["info", "a.off", "--threads", "many"], "'many' is not valid: expected an integer (at least 0)"),
    (["info", "a.off", "--threads", "-2"], "'-2' is not valid: expected an integer (at least 0)"),
    (["info", "a.off", "--report"], "--report"),
    (["winding", "a.off", "-o", "b.vti", "--resolution", "1"], "at least 2"),
    (["winding", "a.off", "-o", "b.vti", "--resolution", "1e9"], "expected an integer"),
    (["winding", "a.off", "-o", "b.vti", "--method", "guess"], "'guess' is not valid: expected auto|exact"),
    (["winding", "a.off", "-o", "b.vti", "--method", "auto", "--method", "exact"], "--method"),
    (["tetrahedralize", "a.off", "-o", "b.vtu", "--winding-threshold", "nan"], "expected a finite number"),
    (["handles", "a.off", "-o", "b.vtp", "--number-of-points", "0"], "at least 1"),
    (["weights", "a.off", "-o", "b.vtp"], "--handles is required"),
    (["deform", "a.vtp", "--handles", "h.tgf", "-o", "b.vtp"], "--pose is required"),
])
def test_usage_errors_are_one_line(folder, words, sentence):
    run = folder.run(*words)
    assert run.code == 1
    assert run.out == ""
    assert run.err.count("\n") == 1 and run.err.startswith("bindpose")
    assert sentence in run.err
    assert run.new_files == []
