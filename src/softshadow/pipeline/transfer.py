"""placeholder"""


def copy_to_texture(command, storage):
    raise NotImplementedError
