# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""Files of Debian packages, without installing them and without any right: apt-get downloads a package (and checks its
signature), dpkg-deb extracts it into a folder. A package that is installed already is not downloaded."""
import os
import pathlib
import shutil
import subprocess
import sys

TIMEOUT_S = 900


class Unavailable(Exception):
    """The package cannot be had."""


def run(*command, cwd=None):
    """What the command says; Unavailable, with its own words, if it fails."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, cwd=cwd)
    except FileNotFoundError:
        raise Unavailable(f"there is no {command[0]}: this needs Debian or a relative") from None
    except subprocess.TimeoutExpired:
        raise Unavailable(f"{command[0]} took more than {TIMEOUT_S} s") from None
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.startswith("E:")] or done.stderr.splitlines()
        raise Unavailable(lines[0] if lines else f"{command[0]} failed")
    return done.stdout


def download(package, folder):
    """The package's file, by the system's package lists or, where there are none yet, by lists of our own."""
    apt = ["apt-get", "-q"]
    for option in ("Acquire::Retries=1", "Acquire::http::Timeout=20", "APT::Update::Error-Mode=any"):
        apt += ["-o", option]
    folder = pathlib.Path(folder).resolve()
    try:
        run(*apt, "download", package, cwd=folder)
    except Unavailable:
        for part in ("lists/partial", "cache/archives/partial"):
            (folder / part).mkdir(parents=True, exist_ok=True)
        apt += ["-o", f"Dir::State::lists={folder}/lists", "-o", f"Dir::Cache={folder}/cache"]
        run(*apt, "update", cwd=folder)
        run(*apt, "download", package, cwd=folder)
    return next(folder.glob(f"{package}_*.deb"))


def package_path(package, path, folder):
    """Where a file or folder of a package is: installed, extracted earlier, or extracted now into `folder`."""
    ours = pathlib.Path(folder) / package
    for root in (pathlib.Path("/"), ours):
        if (root / path).exists():
            return root / path
    if not ours.exists():
        print(f"  downloading {package}", file=sys.stderr)
        archive = download(package, folder)
        part = ours.with_name(package + ".part")  # whole or not at all
        shutil.rmtree(part, ignore_errors=True)
        run("dpkg-deb", "--extract", str(archive), str(part))
        part.rename(ours)
        archive.unlink()
    if not (ours / path).exists():
        raise Unavailable(f"the package {package} has no {path} any more")
    return ours / path


def package_file(package, path, folder):
    """The bytes of a file of a package."""
    return package_path(package, path, folder).read_bytes()


def cache_folder(root):
    """Where packages are kept between runs."""
    folder = pathlib.Path(root) / ".cache" / "packages"
    folder.mkdir(parents=True, exist_ok=True)
    os.chmod(folder, 0o755)  # apt's own user must be able to read it
    return folder


def need_modules(root, **packages):
    """Makes sure that Python modules can be imported (module=package), installing Debian's packages of them."""
    def missing():
        return [package for module, package in packages.items()
                if subprocess.run([sys.executable, "-c", f"import {module}"], capture_output=True).returncode != 0]
    if not missing():
        return
    script = pathlib.Path(sys.argv[0]).resolve()
    install = subprocess.run(["bash", "-c", f'. "$1"; need {" ".join(missing())}', str(script),
                              str(pathlib.Path(root) / "cmake" / "prepare.sh")])
    if install.returncode != 0:
        sys.exit(install.returncode)
    if missing():  # this is not the system's Python
        if sys.executable == "/usr/bin/python3":
            sys.exit(f"{script.name}: {', '.join(missing())} installed, and still not importable")
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
