"""``python -m softshadow`` is ``softshadow``."""

from softshadow.cli import main

if __name__ == "__main__":
    main(prog_name="softshadow")
