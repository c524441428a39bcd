# SPDX-License-Identifier: MIT
"""A tree of MeshLab's programs and plugins in which ours are, without being root: MeshLab 2020.09 looks for its plugins beside
its program, which therefore is a copy; the rest is linked."""
import glob
import os
import shutil

SKIP = 77
PROGRAMS = ("meshlab", "meshlabserver")


def missing(*programs):
    """The first program that is not installed, or None."""
    return next((p for p in programs if shutil.which(p) is None), None)


def make_prefix(folder, plugins):
    libraries = glob.glob("/usr/lib/*/meshlab") + ["/usr/lib/meshlab"]
    inside = os.path.join(folder, os.path.relpath(libraries[0], "/usr"))
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "bin"))
    os.makedirs(os.path.join(inside, "plugins"))
    for program in PROGRAMS:
        shutil.copy(shutil.which(program), os.path.join(folder, "bin", program))
    for file in glob.glob(libraries[0] + "/*.so*"):
        os.symlink(file, os.path.join(inside, os.path.basename(file)))
    for file in glob.glob(libraries[0] + "/plugins/*.so"):
        os.symlink(file, os.path.join(inside, "plugins", os.path.basename(file)))
    for file in plugins:
        link = os.path.join(inside, "plugins", os.path.basename(file))
        if os.path.lexists(link):  # that of an installed fairsurf
            os.remove(link)
        shutil.copy(file, link)
    return folder
