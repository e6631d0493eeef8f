# Doxygen's view of a header: says of defaulted and deleted members all that there is to say, so that nobody writes it.
s|= default;$|&  ///< Made by the compiler, member by member.|
s|= delete;$|&  ///< There is none.|
