"""``softshadow techniques`` and ``softshadow scenes``: list what can be drawn."""

from __future__ import annotations

import click

from softshadow.cli.arguments import as_json, examples
from softshadow.cli.console import print_json, show, table
from softshadow.cli.names import TechniqueName


@click.command(epilog=examples("softshadow techniques", "softshadow techniques map"))
@click.argument("name", type=TechniqueName(), metavar="[TECHNIQUE]", required=False)
@as_json
def techniques(name: str | None, as_json: bool) -> None:
    """List the techniques, or describe one and its options."""
    from softshadow import techniques as registry
    from softshadow.course import explain_codes

    names = [name] if name else registry.names()
    entries = [registry.get(each) for each in names]
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
            for each in entries
        ]
        print_json("techniques", techniques=rows)
    elif name:
        text = registry.describe(name)
        show(text)
        codes = explain_codes(text)
        if codes:
            show("\n".join(["", *codes]))
    else:
        table("Techniques", ["name", "title", "paper"], [[each.name, each.title, each.paper] for each in entries])


@click.command(epilog=examples("softshadow scenes", "softshadow scenes --json"))
@as_json
def scenes(as_json: bool) -> None:
    """List the built-in scenes."""
    from softshadow.scene import Scene, scene_names

    scenes = [Scene.named(name) for name in scene_names()]
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
            for scene in scenes
        ]
        print_json("scenes", scenes=rows)
    else:
        table("Scenes", ["name", "description"], [[scene.name, scene.title] for scene in scenes])
