"""Call the command line inside this process, so that kernels are compiled only once."""

import json
import re
from typing import Any

from click.testing import CliRunner, Result

from softshadow.cli import main


def invoke(*arguments: object) -> Result:
    """Return exit_code, stdout and stderr of a command; it must not print a traceback."""
    result = CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="softshadow")
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert "Traceback" not in result.output
    return result


def invoke_ok(*arguments: object) -> Result:
    """Return the result of a command that must succeed."""
    result = invoke(*arguments)
    assert result.exit_code == 0, result.stderr
    return result


def json_of(*arguments: object) -> dict[str, Any]:
    """Return the JSON that a command prints, and check its schema."""
    result = json.loads(invoke_ok(*arguments, "--json").stdout)
    assert result["schema"] == f"softshadow/{arguments[0]}/1"
    return result


def error_of(*arguments: object, exit_code: int = 3) -> str:
    """Return the message of a command that must reject bad input with exit code 3 and an empty stdout."""
    result = invoke(*arguments)
    assert result.exit_code == exit_code, result.output
    assert result.stdout == ""
    errors = [line for line in result.stderr.splitlines() if not line.startswith(("warning: ", "compiling "))]
    assert errors[0].startswith("error: ")
    return "\n".join(errors).removeprefix("error: ")


def usage_error_of(*arguments: object) -> str:
    """Return the message of a command that must refuse its arguments with exit code 2, and name the help."""
    message, helped = error_of(*arguments, exit_code=2).splitlines()
    assert re.fullmatch(r"help: softshadow( [a-z]+)? --help", helped)
    return message
