"""placeholder"""
def draw(command, storage): raise NotImplementedError
def clear(command, storage): raise NotImplementedError
