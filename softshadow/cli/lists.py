"""``softshadow techniques`` and ``softshadow scenes``."""

from __future__ import annotations

import click

from softshadow.cli.arguments import as_json
from softshadow.cli.console import print_json, table


@click.command(epilog="Examples:  softshadow techniques  |  softshadow techniques map")
@click.argument("name", required=False)
@as_json
def techniques(name: str | None, as_json: bool) -> None:
    """List the techniques, or describe one with its options."""
    from softshadow import techniques as register

    names = [name] if name else register.names()
    found = [register.get(each) for each in names]
    if as_json:
        rows = [
            {
                "name": each.name,
                "title": each.title,
                "family": each.family,
                "paper": each.paper,
                "options": {
                    key: {"default": option.default, "expected": option.expected, "help": option.help}
                    for key, option in each.options.items()
                },
            }
            for each in found
        ]
        print_json("techniques", techniques=rows)
    elif name:
        click.echo(register.describe(name))
    else:
        table("Techniques", ["name", "title", "paper"], [[each.name, each.title, each.paper] for each in found])


@click.command(epilog="Examples:  softshadow scenes  |  softshadow scenes --json")
@as_json
def scenes(as_json: bool) -> None:
    """List the named scenes and what each is for."""
    from softshadow.scene import Scene, scene_names

    found = [Scene.named(name) for name in scene_names()]
    if as_json:
        rows = [
            {
                "name": scene.name,
                "title": scene.title,
                "lights": len(scene.lights),
                "casters": len(scene.casters),
                "receivers": len(scene.receivers),
                "triangles": sum(len(each.mesh.triangles) for each in scene.objects),
            }
            for scene in found
        ]
        print_json("scenes", scenes=rows)
    else:
        table("Scenes", ["name", "what it shows"], [[scene.name, scene.title] for scene in found])
