"""Running a filter from Python: its status as exception, warning or report; progress, cancel and Ctrl-C."""

import os
import signal
import subprocess
import sys
import textwrap
import threading

import bindpose
import pytest
import shapes
from bindpose.meshes import to_dataset


def field(samples):
    filter_ = bindpose.vtkWindingNumberField()
    filter_.SetInputData(0, to_dataset(shapes.sphere(60, 30)))
    filter_.SetResolution(samples)
    return filter_


def test_progress_has_phases_and_grows():
    seen = []
    report = bindpose.run(field(96), lambda fraction, phase: seen.append((fraction, phase)))
    assert report["status"] == "ok"
    assert {phase for _fraction, phase in seen} >= {"build", "evaluate"}
    fractions = [fraction for fraction, _phase in seen]
    assert fractions == sorted(fractions) and fractions[-1] <= 1


def test_seconds_are_in_the_report_and_not_in_the_data(tmp_path):
    filter_ = field(8)
    report = bindpose.run(filter_)
    data = filter_.GetOutput()
    names = [data.GetFieldData().GetArrayName(k) for k in range(data.GetFieldData().GetNumberOfArrays())]
    assert "Report.winding_volume" in names and not any("seconds" in name or "memory" in name for name in names)
    assert report["seconds"]["total"] > 0 and report["peak_memory_bytes"] > 0
    assert bindpose.report(filter_) == bindpose.report(data) == report
    bindpose.write(data, tmp_path / "w.vti")
    assert b"econds" not in (tmp_path / "w.vti").read_bytes()
    # The report of a returned dataset contains the times of the run, also if the package has copied the dataset.
    grid = bindpose.winding_number(shapes.cube(), 8)
    assert bindpose.report(grid)["seconds"]["evaluate"] > 0
    # After an Update() without bindpose.run(), the report describes the new data but contains no times.
    filter_.SetResolution(12)
    filter_.Update()
    again = bindpose.report(filter_.GetOutput())
    assert again["counts"]["queries"] > report["counts"]["queries"] and "seconds" not in again


def test_progress_cancels():
    filter_ = field(600)
    with pytest.raises(bindpose.Canceled) as caught:
        bindpose.run(filter_, lambda fraction, phase: False)
    assert caught.value.status == "canceled"
    filter_.SetResolution(8)
    assert bindpose.run(filter_)["status"] == "ok"  # the filter works again after the cancel


def test_an_error_in_the_callback_is_raised():
    with pytest.raises(ZeroDivisionError):
        bindpose.run(field(600), lambda fraction, phase: 1 / 0)


def test_ctrl_c_is_a_keyboard_interrupt():
    filter_ = field(1200)
    main = threading.main_thread().ident
    threading.Timer(0.5, lambda: signal.pthread_kill(main, signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        bindpose.run(filter_)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_nothing_is_printed_where_an_exception_tells():
    code = textwrap.dedent("""
        import bindpose
        try:
            bindpose.read("none.off")
        except bindpose.InvalidInput as error:
            print(error)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=os.environ)
    assert done.stdout == "cannot open none.off: No such file or directory\n"
    assert done.stderr == ""


def test_warnings_are_warnings(tmp_path):
    (tmp_path / "h.tgf").write_text("1 0 0 0\n2 1 0 0\n#\n1 2 0 0 0\n")
    with pytest.warns(bindpose.BindposeWarning, match="pseudo-edges"):
        bindpose.read_handles(tmp_path / "h.tgf")


def test_classes_are_at_package_level():
    for name in ("vtkWindingNumberField", "vtkTetrahedralizeSurface", "vtkBoundedBiharmonicWeights",
                 "vtkMonotoneWeights", "vtkUnconstrainedWeights", "vtkTransferWeights", "vtkPoseHandles",
                 "vtkSkinningDeformation", "vtkReducedARAP", "vtkReducedDynamics", "vtkFullARAP",
                 "vtkVariationalSurface", "vtkMovingLeastSquaresWarp", "vtkWeightedColors",
                 "vtkDepthOrder", "vtkCutAlongBones", "vtkMonotoneSmoothing", "vtkMeshFileReader", "vtkMeshFileWriter",
                 "vtkHandleFileReader", "vtkAutomaticHandles", "vtkFarthestPointHandles", "vtkHandleSetWidget",
                 "vtkRegionBrushWidget", "vtkBoneEndpointWeights", "vtkPlacedHandles", "vtkShareDataset"):
        assert hasattr(bindpose, name)
        assert name in str(getattr(bindpose, name)())


def test_warnings_name_the_line_of_the_caller():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    with pytest.warns(bindpose.BindposeWarning) as caught:
        bindpose.winding_number((points, [[0, 1, 2], [0, 1, 1]]), [[float("nan"), 0, 0]])
    assert all(warning.filename == __file__ for warning in caught)
