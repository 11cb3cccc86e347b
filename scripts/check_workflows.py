# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rules of this project for the workflows that are given, beyond what linters know; called by scripts/check-workflows."""

import re
import subprocess
import sys
from pathlib import Path

from ruamel.yaml import YAML

PINNED = re.compile(r"uses: (?P<action>\S+)@[0-9a-f]{40} # v\d+\.\d+\.\d+$")


def faults(path, rust):
    text = path.read_text(encoding="utf-8")
    workflow = YAML(typ="safe", pure=True).load(text)
    for line in text.splitlines():
        if "uses: " in line and not PINNED.search(line):
            yield f"'{line.strip()}' names no commit with its version (# v1.2.3) behind it"
        if re.search(r"\brust:\d", line) and f"rust:{rust}-" not in line:
            yield f"'{line.strip()}' is not of Rust {rust}, which Cargo.toml names"
    if workflow.get("permissions") != {"contents": "read"}:
        yield "permissions of the workflow are not 'contents: read'; what a job needs beyond stands there"
    if "concurrency" not in workflow:
        yield "no concurrency: runs of a branch would pile up"
    if "secrets." in text:
        yield "a secret: publishing goes by id-token and github.token, of jobs for tags alone"
    for name, job in workflow["jobs"].items():
        if "timeout-minutes" not in job:
            yield f"job {name} has no timeout-minutes"
        if job.get("permissions") and "pull_request" in workflow["on"] and "refs/tags/" not in str(job.get("if")):
            yield f"job {name} has permissions of its own and runs for pull requests"
        for step in job["steps"]:
            if step.get("uses", "").startswith("actions/checkout@") and step.get("with", {}).get("persist-credentials") is not False:
                yield f"job {name} leaves git's credentials behind: persist-credentials is not false"
            script = step.get("run", "")
            if "${{" in script:
                yield f"an expression in a script of job {name}, which could be code: hand it over by env"
            checked = subprocess.run(["bash", "-n"], input=script, text=True, stderr=subprocess.PIPE)
            if checked.returncode != 0:
                yield f"a script of job {name} is no script: {checked.stderr.strip()}"


def left_out(root):
    """Checks that nothing runs, of those in scripts/."""
    run = (root / ".ci/run").read_text(encoding="utf-8")
    run += "".join(path.read_text(encoding="utf-8") for path in sorted((root / ".github/workflows").glob("*.yml")))
    checks = {path.name for path in (root / "scripts").glob("check-*") if path.suffix == ""} - {"check-workflows"}
    return sorted(name for name in checks if not re.search(rf"\b{name}\b", run))


def main():
    root = Path(__file__).resolve().parent.parent
    rust = re.search(r'^rust-version = "(.*)"$', (root / "Cargo.toml").read_text(encoding="utf-8"), re.MULTILINE)[1]
    found = [f"{name}: {fault}" for name in sys.argv[1:] for fault in faults(Path(name), rust)]
    found += [f"scripts/{name} is run by neither .ci/run nor a workflow" for name in left_out(root)]
    print("\n".join(found), file=sys.stderr)
    sys.exit(1 if found else 0)


main()
