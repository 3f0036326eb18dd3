# Turns each line of a text into a string of C.
s/[\\"]/\\&/g
s/.*/    "&\\n",/
