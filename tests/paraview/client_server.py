"""Test the plugin in a client/server session: client_server.py PLUGIN MESH FOLDER.

The script starts pvserver on two MPI ranks, and pvpython as its client. The client computes handles and weights of MESH
on the server, poses the mesh twice and fetches the points. They must equal the points of a client without a server. The
server must end after its client. A client whose server is ended must get an error and must not wait for the server.

The script has a time limit for every process, and runs itself as the client: pvpython client_server.py ROLE …
"""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import sys
import threading
import time

import numpy as np

RANKS = 2
CLIENT_LIMIT = 300  # time limits in seconds
SERVER_LIMIT = 600
END_LIMIT = 60  # limit for the server to end after its client, or vice versa
READY, LOST, UNNOTICED = "ready for the end of the server", "connection lost:", "the lost connection was not noticed"


# ---- The client, in pvpython ------------------------------------------------------------------------


def fetch(proxy):
    from paraview import servermanager

    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy)


def pipeline(simple, mesh):
    """Return the proxies of the handles, of their pose and of the posed mesh."""
    surface = simple.BindposeMeshReader(FileName=mesh)
    handles = simple.AutomaticHandles(Input=surface)
    weights = simple.BoundedBiharmonicWeights(Input=surface, Handles=handles)
    pose = simple.PoseHandles(Input=handles)
    return handles, pose, simple.SkinningDeformation(Input=weights, Handles=pose)


def pose_text(name, degrees):
    return f'{{"handles": {{"{name}": {{"rotate": {{"axis": [0, 0, 1], "degrees": {degrees}}}}}}}}}'


def pose_mesh(simple, mesh, output):
    """Save the points of the mesh in two poses."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    handles, pose, posed = pipeline(simple, mesh)
    names = fetch(handles).GetCellData().GetAbstractArray("HandleName")
    points = []
    for degrees in (0, 30, 70):
        pose.PoseJSON = pose_text(names.GetValue(names.GetNumberOfValues() - 1), degrees)
        data = fetch(posed)
        arrays = data.GetFieldData()
        status = arrays.GetAbstractArray("Report.status").GetValue(0)
        assert status == "ok", f"{status}: {arrays.GetAbstractArray('Report.message').GetValue(0)}"
        assert arrays.GetArray("Report.binds").GetTuple1(0) == 1, "a pose has repeated the bind"
        points.append(vtk_to_numpy(data.GetPoints().GetData()).copy())
    np.save(output, points)


def connect(simple, port, plugin):
    """Connect to the server, and load the plugin there and in the client."""
    connection = simple.Connect("localhost", port)
    assert connection is not None, f"no connection to port {port}"
    assert connection.IsRemote() and connection.GetNumberOfDataPartitions() == RANKS
    simple.LoadPlugin(plugin, remote=True)
    simple.LoadPlugin(plugin, remote=False)
    return connection


def built_in(plugin, mesh, output):
    from paraview import simple

    simple.LoadPlugin(plugin, remote=False)
    pose_mesh(simple, mesh, output)


def connected(port, plugin, mesh, output):
    from paraview import simple

    connect(simple, int(port), plugin)
    pose_mesh(simple, mesh, output)
    simple.Disconnect()


def abandoned(port, plugin, mesh):
    """Change a pose after the server has ended, and report how the client notices it."""
    from paraview import simple

    connection = connect(simple, int(port), plugin)
    handles, pose, posed = pipeline(simple, mesh)
    name = fetch(handles).GetCellData().GetAbstractArray("HandleName").GetValue(0)
    fetch(posed)
    print(READY, flush=True)
    sys.stdin.readline()
    noticed = ""
    for degrees in range(30, 60):  # a busy machine ends the server some time after its parent process
        try:
            pose.PoseJSON = pose_text(name, degrees)
            data = fetch(posed)
            noticed = "no data" if data is None else "" if connection.Session.GetIsAlive() else "the session is not alive"
        except Exception as error:  # any exception reports the lost connection
            noticed = f"{type(error).__name__}: {error}"
        if noticed:
            break
        time.sleep(1)
    print(f"{LOST} {noticed}" if noticed else UNNOTICED, flush=True)
    os._exit(0)  # the normal end would send messages to the server


# ---- The test ---------------------------------------------------------------------------------------


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def server(log):
    """Start pvserver. Yield its process and port, and end it if it is still running."""
    port = free_port()
    words = ["timeout", "--kill-after=10", str(SERVER_LIMIT), "mpirun", "--bind-to", "none", "-n", str(RANKS),
             "pvserver", f"--server-port={port}"]
    with open(log, "wb") as file:
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT)
    try:
        yield process, port
    finally:
        end(process)


def end(process):
    """End a server. The program `timeout` passes the signal on to mpirun, which ends the ranks."""
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(END_LIMIT)
    if process.poll() is None:
        process.kill()
        process.wait()


def client_words(role, *words):
    return ["pvpython", str(pathlib.Path(__file__).resolve()), role, *(str(word) for word in words)]


def run_client(log, role, *words):
    with open(log, "wb") as file:
        done = subprocess.run(["timeout", "--kill-after=10", str(CLIENT_LIMIT), *client_words(role, *words)],
                              stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        reason = f"took longer than {CLIENT_LIMIT} s" if done.returncode == 124 else f"exit code {done.returncode}"
        sys.exit(f"the client '{role}' failed ({reason}); the log is {log}")


def compare_sessions(plugin, mesh, folder):
    """Check that a session with a server computes the same points as a session without a server."""
    run_client(folder / "client-built-in.log", "built-in", plugin, mesh, folder / "built-in.npy")
    with server(folder / "server-connected.log") as (process, port):
        run_client(folder / "client-connected.log", "connected", port, plugin, mesh, folder / "connected.npy")
        try:
            process.wait(END_LIMIT)
        except subprocess.TimeoutExpired:
            sys.exit(f"the server still runs {END_LIMIT} s after its client has disconnected")
    alone, remote = np.load(folder / "built-in.npy"), np.load(folder / "connected.npy")
    assert alone.shape == remote.shape, (alone.shape, remote.shape)
    size = np.linalg.norm(np.ptp(alone[0], axis=0))
    moved = [np.linalg.norm(points - alone[0], axis=1).max() for points in alone[1:]]
    assert 1e-3 * size < moved[0] < moved[1], f"the poses move points by {moved}, the diagonal is {size}"
    difference = np.abs(alone - remote).max()
    assert difference <= 1e-12 * size, f"the points differ by {difference}"
    return alone.shape[1], difference / size


def end_server_under_client(plugin, mesh, folder):
    """End the server of a client. Return what the client prints about it."""
    log = folder / "client-abandoned.log"
    with server(folder / "server-abandoned.log") as (process, port), open(log, "w") as errors:
        client = subprocess.Popen(client_words("abandoned", port, plugin, mesh), stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=errors, text=True)
        deadline = threading.Timer(CLIENT_LIMIT, client.kill)
        deadline.start()
        try:
            if not any(READY in line for line in client.stdout):
                sys.exit(f"the client did not get ready within {CLIENT_LIMIT} s; the log is {log}")
            end(process)
            try:
                text, _ = client.communicate("\n", timeout=END_LIMIT)
            except subprocess.TimeoutExpired:
                sys.exit(f"the client still waits {END_LIMIT} s after its server has ended; the log is {log}")
        finally:
            deadline.cancel()
            if client.poll() is None:
                client.kill()
                client.wait()
    lost = [line for line in text.splitlines() if line.startswith(LOST)]
    assert lost and client.returncode == 0, f"exit code {client.returncode}, output: {text!r}; the log is {log}"
    return lost[0]


def main():
    plugin, mesh, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    count, difference = compare_sessions(plugin, mesh, folder)
    print(f"{count} points posed by pvserver on {RANKS} ranks: largest difference from a session without server "
          f"{difference:.0e} diagonals")
    print(f"the client of a server that has ended: {end_server_under_client(plugin, mesh, folder)}")
    return 0


if __name__ == "__main__":
    roles = {"built-in": built_in, "connected": connected, "abandoned": abandoned}
    role = roles.get(sys.argv[1] if len(sys.argv) > 1 else "")
    sys.exit(role(*sys.argv[2:]) if role else main())
